#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace knot_utm {

/// A folder for each test, not there at first and gone in the end.
class OwnFolder : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove_all(folder()); }
  void TearDown() override { std::filesystem::remove_all(folder()); }

  static std::string folder() {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    return testing::TempDir() + "knot_utm_" + test.test_suite_name() + "_" + test.name() + "_" +
           std::to_string(getpid());
  }
  static std::string in(const std::string& name) { return folder() + "/" + name; }
};

/// The same, made before the test begins.
class MadeFolder : public OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    std::filesystem::create_directories(folder());
  }
};

}  // namespace knot_utm
