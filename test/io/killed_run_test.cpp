// tensile_test that is killed, or has no room to write, as a user has it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "io/own_folder.hpp"
#include "knot_utm/io/journal.hpp"
#include "knot_utm/io/run_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kTools = std::string(KNOT_UTM_TOOLS_DIR) + "/";
// Without checkpoints: on a slow machine one may be due, and notice first what the journal is to notice.
const std::string kTest = kTools + "tensile_test " + KNOT_UTM_SOURCE_DIR +
                          "/config/tighten.yaml --quiet --checkpoint 0 --set physics.accuracy=draft" +
                          " --set 'program=[{hold: {duration: 20}}]' --out ";

/// So many bytes of a journal are well beyond the first records, and well before the last.
constexpr std::uintmax_t kSomeRecords = 200000;

class KilledRun : public OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    fs::create_directories(folder());
  }

  std::string in(const char* name) const { return folder() + "/" + name; }

  int shell(const std::string& command) const {
    return WEXITSTATUS(std::system((command + " 2>" + in("said")).c_str()));
  }

  /// A test in the background that has some records behind it.
  pid_t start(const std::string& out) const {
    const std::string command = "exec " + kTest + out + " 2>" + in("said");
    const pid_t test = fork();
    if (test == 0) {
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    std::error_code error;
    siginfo_t ended{};
    while (ended.si_pid == 0 &&
           (!fs::exists(journal_file(out), error) || fs::file_size(journal_file(out), error) < kSomeRecords)) {
      usleep(1000);
      waitid(P_PID, static_cast<id_t>(test), &ended, WEXITED | WNOHANG | WNOWAIT);
    }
    return test;
  }

  static int status_of(pid_t process) {
    int status = 0;
    waitpid(process, &status, 0);
    return status;
  }

  void expect_beginning_of_unbroken(const std::string& out) const {
    ASSERT_EQ(shell(kTest + in("unbroken")), 0);
    for (const char* name : {"curve.csv", "curve_full.csv"}) {
      EXPECT_THAT(read_whole(in("unbroken") + "/" + name), StartsWith(read_whole(out + "/" + name))) << name;
    }
  }
};

TEST_F(KilledRun, IsRecoveredToTheLastAnswer) {
  const pid_t test = start(in("killed"));
  kill(test, SIGKILL);
  ASSERT_TRUE(WIFSIGNALED(status_of(test))) << "the test was over before it could be killed";

  ASSERT_EQ(shell(kTools + "recover " + in("killed")), 0) << read_whole(in("said"));
  EXPECT_THAT(read_whole(in("killed/result.yaml")), HasSubstr("ended_by: not yet"));
  EXPECT_GT(fs::file_size(in("killed/curve.csv")), 200u);
  expect_beginning_of_unbroken(in("killed"));
}

TEST_F(KilledRun, WhoseFolderIsRemovedSaysSoAtOnce) {
  const pid_t test = start(in("removed"));
  fs::remove_all(in("removed"));
  const int status = status_of(test);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_EQ(read_whole(in("said")),
            "tensile_test: the journal " + in("removed/journal") + " was removed while the test was running\n");
}

TEST_F(KilledRun, WithoutRoomSaysSoInOneLineAndIsRecoveredElsewhere) {
  // In blocks of 512 bytes, as POSIX has it.
  const std::string blocks = std::to_string(kSomeRecords / 512);
  EXPECT_EQ(shell("ulimit -f " + blocks + "; exec " + kTest + in("full")), 1);
  const std::string said = read_whole(in("said"));
  EXPECT_THAT(said, AllOf(HasSubstr(": file too large"), HasSubstr("recover " + in("full"))));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_FALSE(fs::exists(in("full/result.yaml")));

  ASSERT_EQ(shell(kTools + "recover " + in("full") + " --out " + in("other")), 0) << read_whole(in("said"));
  EXPECT_THAT(read_whole(in("other/result.yaml")), HasSubstr("ended_by: not yet"));
  EXPECT_EQ(read_whole(in("other/curve.csv")), read_whole(in("full/curve.csv")));
  expect_beginning_of_unbroken(in("other"));
}

TEST_F(KilledRun, RecoverNamesWhatItCannotRead) {
  EXPECT_EQ(shell(kTools + "recover " + in("nothing")), 2);
  EXPECT_THAT(read_whole(in("said")), HasSubstr(in("nothing/journal")));
  EXPECT_EQ(shell(kTools + "recover"), 2);
}

}  // namespace
}  // namespace knot_utm
