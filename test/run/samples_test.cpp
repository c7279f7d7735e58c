#include "knot_utm/run/samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample_fields.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Samples : public MadeFolder {
 protected:
  /// Any number that a double can be.
  double number() {
    const std::vector<double> odd{0.0, -0.0, std::nan(""), -INFINITY, 5e-324, 1e300, 0.1, -1.0 / 3.0};
    const std::size_t one = random_() % (2 * odd.size());
    return one < odd.size() ? odd[one] : std::ldexp(static_cast<double>(random_()), static_cast<int>(one) - 60);
  }
  Sample sample(std::uint64_t sequence) {
    Sample out;
    visit_sample_fields([&](const auto& field) {
      auto& value = field.of(out);
      using Value = std::remove_reference_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, double>)
        value = number();
      else if constexpr (std::is_same_v<Value, Phase>)
        value = static_cast<Phase>(random_() % (1 + static_cast<unsigned>(last_phase())));
      else if constexpr (std::is_enum_v<Value>)
        value = static_cast<Value>(static_cast<int>(random_() % (1 + static_cast<unsigned>(last_of(Value())))));
      else if constexpr (std::is_same_v<Value, PerKnot>)
        value = sequence % 2 == 0 ? PerKnot() : PerKnot{number(), number()};
      else if constexpr (!std::is_same_v<Value, std::string>)
        value = static_cast<Value>(random_() >> 1);
    });
    out.sequence = sequence;
    if (sequence % 3 == 1) out.message = R"(a "word", another ä)";
    return out;
  }
  Record record(std::uint64_t sequence) {
    Record out;
    out.wall_time = number();
    out.command = {
        sequence,     number(), number(), number(),          number(),         static_cast<int>(sequence % 5) - 1,
        Phase::kPull, number(), number(), sequence % 2 == 0, sequence % 2 == 1};
    out.answer = sample(sequence);
    for (std::uint64_t k = 0; k < sequence % 4; ++k) out.steps.push_back(sample(sequence));
    if (sequence % 2 == 1) out.shape = Points::Random(3, 5);
    if (sequence % 2 == 1) out.tension = Eigen::VectorXd::Random(4);
    if (sequence % 4 == 3) out.readings = RodReadings{Eigen::VectorXd::Random(3), Eigen::VectorXd::Random(5)};
    return out;
  }
  static std::string bytes_of(Record record) {
    Archive archive("record");
    archive(record.wall_time, record.command, record.answer);
    archive.list(record.steps);
    archive.list(record.shape);
    archive.list(record.tension);
    archive(record.readings);
    return archive.bytes();
  }
  static std::string rows() { return read_whole(samples_file(folder())); }
  static std::string shapes() { return read_whole(folder() + "/shapes.bin"); }

 private:
  std::mt19937_64 random_{41};
};

TEST_F(Samples, GiveBackEveryBit) {
  std::vector<Record> records;
  for (std::uint64_t k = 0; k < 40; ++k) records.push_back(record(k));
  const Points last = Points::Random(3, 5);
  {
    SamplesWriter writer(folder());
    for (const Record& one : records) writer.append(one);
    writer.end({EndedBy::kLoad, "it is \"enough\", one says"}, last);
  }
  SamplesReader reader(folder());
  Record found;
  for (const Record& one : records) {
    ASSERT_TRUE(reader.next(found));
    EXPECT_EQ(bytes_of(found), bytes_of(one)) << one.command.sequence;
  }
  EXPECT_FALSE(reader.next(found));
  ASSERT_TRUE(reader.end());
  EXPECT_EQ(reader.end()->ended_by, EndedBy::kLoad);
  EXPECT_EQ(reader.end()->reason, "it is \"enough\", one says");
  EXPECT_EQ(reader.final_shape(), last);
  EXPECT_EQ(reader.torn_bytes(), 0u);
}

/// As a process that is killed leaves them, or a disk that is full.
TEST_F(Samples, TornAnywhereTheyEndWithTheLastWholeCommand) {
  std::vector<std::size_t> ends;  // of the commands
  std::vector<Record> records;
  {
    SamplesWriter writer(folder());
    for (std::uint64_t k = 0; k < 6; ++k) {
      records.push_back(record(k));
      writer.append(records.back());
      ends.push_back(fs::file_size(samples_file(folder())));
    }
  }
  for (std::size_t bytes = ends[5]; bytes >= ends[2]; bytes -= 7) {
    fs::resize_file(samples_file(folder()), bytes);
    SamplesReader reader(folder());
    Record found;
    while (reader.next(found)) EXPECT_EQ(bytes_of(found), bytes_of(records[reader.records() - 1]));
    const auto whole = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), bytes) - ends.begin());
    ASSERT_EQ(reader.records(), whole);
    EXPECT_EQ(reader.torn_bytes(), bytes - ends[whole - 1]);
  }
}

TEST_F(Samples, AnyBytesAreUnderstoodOrRefusedInOneLine) {
  {
    SamplesWriter writer(folder());
    for (std::uint64_t k = 0; k < 4; ++k) writer.append(record(k));
    writer.end({EndedBy::kBreak, ""}, Points::Random(3, 5));
  }
  const std::string good_rows = rows(), good_shapes = shapes();
  const std::size_t head = good_rows.find("\nstep,") + 1;
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string bad_rows = good_rows, bad_shapes = good_shapes;
    for (std::size_t n = random() % 3; n > 0; --n)
      bad_rows[head + random() % (bad_rows.size() - head)] = ",\"\n9aE\xff\0"[random() % 8];
    for (std::size_t n = random() % 3; n > 0; --n)
      bad_shapes[random() % bad_shapes.size()] = static_cast<char>(random());
    write_whole(samples_file(folder()), bad_rows);
    write_whole(folder() + "/shapes.bin", bad_shapes);
    try {
      SamplesReader reader(folder());
      Record found;
      while (reader.next(found)) continue;
      EXPECT_LE(reader.records(), 5u);
    } catch (const InvalidInput& invalid) {
      ++refused;
      EXPECT_EQ(std::string(invalid.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(refused, 30);
}

TEST_F(Samples, AreBegunOnce) {
  const SamplesWriter writer(folder());
  EXPECT_THROW(SamplesWriter{folder()}, std::runtime_error);
}

}  // namespace
}  // namespace knot_utm
