#include "knot_utm/words/text_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace knot_utm {
namespace {

TEST(TextRows, AreCountedWithOrWithoutALastLineEnd) {
  for (const char* text : {"a\n\nb", "a\n\nb\n"}) {
    std::istringstream in(text);
    TextRows rows(in);
    for (const char* row : {"a", "", "b"}) {
      ASSERT_TRUE(rows.next());
      EXPECT_EQ(rows.text(), row);
    }
    EXPECT_EQ(rows.number(), 3u);
    EXPECT_FALSE(rows.next());
    EXPECT_EQ(rows.fault(), "");
  }
}

TEST(TextRows, OfAFileThatIsNotThereAreNone) {
  std::istringstream in;
  in.setstate(std::ios::failbit);
  EXPECT_FALSE(TextRows(in).next());
}

/// A text without end: no more of it is read than the bounds let through.
class Endless : public std::streambuf {
 public:
  explicit Endless(std::size_t row) : text_(row, 'x') { text_ += '\n'; }

 protected:
  int_type underflow() override {
    setg(text_.data(), text_.data(), text_.data() + text_.size());
    return traits_type::to_int_type(text_.front());
  }

 private:
  std::string text_;
};

TEST(TextRows, EndWhereABoundIsPassed) {
  Endless many(0), wide(5000);
  std::istream many_in(&many), wide_in(&wide);
  TextRows many_rows(many_in), wide_rows(wide_in);
  std::size_t count = 0;
  while (many_rows.next()) ++count;
  EXPECT_EQ(count, 2000000u);
  EXPECT_EQ(many_rows.fault(), "there are more than 2000000 rows");
  EXPECT_FALSE(many_rows.next());
  EXPECT_FALSE(wide_rows.next());
  EXPECT_EQ(wide_rows.fault(), "row 1 is longer than 4096 characters");
}

}  // namespace
}  // namespace knot_utm
