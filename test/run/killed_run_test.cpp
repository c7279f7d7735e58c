// tensile_test that is killed, or has no room to write, as a user has it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <string>

#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/samples.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kTool = std::string(KNOT_UTM_TOOLS_DIR) + "/tensile_test ";
const std::string kTest = kTool + KNOT_UTM_SOURCE_DIR + "/config/tighten.yaml --quiet --set physics.accuracy=draft" +
                          " --set 'program=[{hold: {duration: 20}}]' --out ";

/// So many bytes of samples are well beyond the first, and well before the last.
constexpr std::uintmax_t kSomeSamples = 60000;

class KilledRun : public MadeFolder {
 protected:
  static int shell(const std::string& command) {
    return WEXITSTATUS(std::system((command + " 2>" + in("said")).c_str()));
  }
  static std::string said() { return read_whole(in("said")); }

  /// A test in the background that has some samples behind it.
  static pid_t start(const std::string& out) {
    const std::string command = "exec " + kTest + out + " 2>" + in("said");
    const pid_t test = fork();
    if (test == 0) {
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    std::error_code error;
    siginfo_t ended{};
    while (ended.si_pid == 0 &&
           (!fs::exists(samples_file(out), error) || fs::file_size(samples_file(out), error) < kSomeSamples)) {
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

  static void expect_beginning_of_unbroken(const std::string& out) {
    ASSERT_EQ(shell(kTest + in("unbroken")), 0);
    for (const char* name : {"curve.csv", "curve_full.csv"})
      EXPECT_THAT(read_whole(in("unbroken/") + name), StartsWith(read_whole(out + "/" + name))) << name;
    EXPECT_THAT(read_whole(samples_file(out)), HasSubstr("\nanswer,"));
    const std::string samples = read_whole(samples_file(out)), curve = read_whole(out + "/curve_full.csv");
    const auto steps = std::count(curve.begin(), curve.end(), '\n');
    std::string::difference_type written = 2;
    for (std::size_t at = samples.find("\nstep,"); at != std::string::npos; at = samples.find("\nstep,", at + 1))
      ++written;
    EXPECT_EQ(steps, written) << "a time step that was answered is lost";
  }
};

TEST_F(KilledRun, LosesNothingThatWasAnswered) {
  const pid_t test = start(in("killed"));
  kill(test, SIGKILL);
  ASSERT_TRUE(WIFSIGNALED(status_of(test))) << "the test was over before it could be killed";
  EXPECT_FALSE(fs::exists(in("killed/result.yaml")));

  ASSERT_EQ(shell(kTool + "--quiet --from-samples " + in("killed")), 0) << said();
  EXPECT_THAT(read_whole(in("killed/result.yaml")),
              AllOf(HasSubstr("ended_by: not yet"), HasSubstr("reason: \"the test was cut off\"")));
  expect_beginning_of_unbroken(in("killed"));
}

TEST_F(KilledRun, ItsFilesAreMadeAgainToTheByte) {
  ASSERT_EQ(shell(kTest + in("run")), 0);
  fs::copy(in("run"), in("before"));
  for (const fs::directory_entry& file : fs::directory_iterator(in("before"))) {
    const std::string name = file.path().filename();
    if (name != "samples.csv" && name != "shapes.bin" && name != "method.yaml") fs::remove(in("run/") + name);
  }
  ASSERT_EQ(shell(kTool + "--quiet --from-samples " + in("run")), 0) << said();
  for (const fs::directory_entry& file : fs::directory_iterator(in("before"))) {
    const std::string name = file.path().filename();
    // Who makes the files anew does not know how much memory the test took.
    const auto text = [&](const char* folder) {
      return std::regex_replace(read_whole(in(folder) + "/" + name), std::regex("peak_memory: [^\n]*\n"), "");
    };
    EXPECT_TRUE(text("run") == text("before")) << name;
  }
}

TEST_F(KilledRun, WhoseFolderIsRemovedSaysSoAtOnce) {
  const pid_t test = start(in("removed"));
  fs::remove_all(in("removed"));
  const int status = status_of(test);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_THAT(said(), HasSubstr(" was removed while the test was running\n"));
}

TEST_F(KilledRun, WithoutRoomSaysInOneLineWhatStands) {
  // In blocks of 512 bytes, as POSIX has it.
  EXPECT_EQ(shell("ulimit -f " + std::to_string(kSomeSamples / 512) + "; exec " + kTest + in("full")), 1);
  EXPECT_THAT(said(), AllOf(HasSubstr(": file too large; what was measured until then stands in " + in("full")),
                            HasSubstr("--from-samples " + in("full"))));
  const std::string line = said();
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
  EXPECT_FALSE(fs::exists(in("full/result.yaml")));

  ASSERT_EQ(shell(kTool + "--quiet --from-samples " + in("full")), 0) << said();
  expect_beginning_of_unbroken(in("full"));
}

TEST_F(KilledRun, WithoutSamplesNothingIsMade) {
  EXPECT_EQ(shell(kTool + "--from-samples " + in("nothing")), 2);
  EXPECT_THAT(said(), HasSubstr("there is no samples.csv in " + in("nothing")));
  EXPECT_FALSE(fs::exists(in("nothing")));
}

TEST_F(KilledRun, WhatIsStillWrittenIsLeftAlone) {
  const pid_t test = start(in("runs"));
  // It stands still, so that it goes on for certain.
  kill(test, SIGSTOP);
  siginfo_t stopped{};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(test), &stopped, WSTOPPED | WEXITED | WNOWAIT), 0);
  ASSERT_EQ(stopped.si_code, CLD_STOPPED) << "the test was over before it could be stopped";
  const std::string samples = read_whole(samples_file(in("runs")));
  for (const std::string& command : {kTool + "--from-samples " + in("runs"), kTest + in("runs") + " --overwrite"}) {
    EXPECT_EQ(shell(command), 2);
    EXPECT_THAT(said(), HasSubstr("another run is writing to the folder " + in("runs")));
  }
  EXPECT_EQ(read_whole(samples_file(in("runs"))), samples);
  EXPECT_FALSE(fs::exists(in("runs/result.yaml")));
  kill(test, SIGKILL);
  status_of(test);
}

}  // namespace
}  // namespace knot_utm
