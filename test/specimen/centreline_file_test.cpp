#include "knot_utm/specimen/centreline_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "knot_utm/numeric/invalid_input.hpp"

namespace knot_utm {
namespace {

using ::testing::HasSubstr;

class CentrelineFile : public ::testing::Test {
 protected:
  std::string write(const std::string& text) {
    std::ofstream(path_) << text;
    return path_;
  }
  std::string complaint(const std::string& text) {
    try {
      read_centreline(write(text));
    } catch (const InvalidInput& invalid) {
      return invalid.what();
    }
    return "";
  }
  void TearDown() override { std::remove(path_.c_str()); }
  std::string path_ = ::testing::TempDir() + "knot_utm_centreline_" +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
};

TEST_F(CentrelineFile, HeadingsCommentsAndEmptyRowsArePassedOver) {
  const Points points = read_centreline(write("x,y,z\nm,m,m\n# arch\n0,0,0\n\n0, 0, 1e-2\r\n0,1,+2\n-1,1,2\n"));
  ASSERT_EQ(points.cols(), 4);
  EXPECT_EQ(points.col(1), Vec3(0.0, 0.0, 0.01));
  EXPECT_EQ(points.col(3), Vec3(-1.0, 1.0, 2.0));
}

TEST_F(CentrelineFile, WrongRowsAreNamed) {
  EXPECT_THAT(complaint("0,0,0\n0,0\n0,0,2\n0,0,3\n0,0,4\n"), HasSubstr("row 2"));
  EXPECT_THAT(complaint("0,0,0\n0,0,nan\n"), HasSubstr("row 2"));
  EXPECT_THAT(complaint("0,0,0\n0,0,0\n"), HasSubstr("row 2 is the same point as the one before it"));
  EXPECT_THAT(complaint("0,0,0\n0,0,1\n0,0,2\n"), HasSubstr("has 3 points, but must have four or more"));
  EXPECT_THAT(complaint("a\nb\nc\n0,0,0\n"), HasSubstr("row 3"));
  EXPECT_THAT(complaint("0,0,0\n0,0,+-1\n"), HasSubstr("row 2"));
  EXPECT_THAT(complaint("0,0,0\n0,0,1001\n"),
              HasSubstr("row 2 is \"0,0,1001\", but must be three numbers x,y,z from -1000"));
  EXPECT_THAT(complaint("0,0,0\n0,0,1e-200\n"), HasSubstr("row 2 is the same point as the one before it"));
  EXPECT_THAT(complaint("0,0,0\n" + std::string(5000, '0') + ",0,0\n"),
              HasSubstr("row 2 is longer than 4096 characters"));
}

}  // namespace
}  // namespace knot_utm
