// A test that is cut off and taken up again leaves what one leaves that was not.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "io/command.hpp"
#include "io/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A loop that is tied, released, mounted and pulled a little, read by a cell that has noise.
const std::vector<std::string> kTest = {std::string(KNOT_UTM_SOURCE_DIR) + "/config/tighten.yaml",
                                        "--set",
                                        "material=polypropylene",
                                        "--set",
                                        "specimen.preload=20",
                                        "--set",
                                        "specimen.edge_length=0.005",
                                        "--set",
                                        "machine.load_cell={capacity: 5e4, noise: 2, sampling_rate: 5}",
                                        "--set",
                                        "program.release.duration=1",
                                        "--set",
                                        "program.pull.until={extension: 0.003}",
                                        "--set",
                                        "physics.accuracy=draft",
                                        "--quiet"};

std::string text_of(const fs::path& file) {
  std::ostringstream all;
  all << std::ifstream(file, std::ios::binary).rdbuf();
  return all.str();
}

std::set<std::string> files_of(const fs::path& folder) {
  std::set<std::string> out;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) out.insert(entry.path().filename());
  return out;
}

/// tensile_test in a process of its own.
pid_t launch(const std::vector<std::string>& arguments) {
  const std::string command = std::string(KNOT_UTM_TOOLS_DIR) + "/tensile_test";
  std::vector<char*> raw;
  raw.push_back(const_cast<char*>(command.c_str()));
  for (const std::string& argument : arguments) raw.push_back(const_cast<char*>(argument.c_str()));
  raw.push_back(nullptr);
  const pid_t process = fork();
  if (process == 0) {
    execv(command.c_str(), raw.data());
    _exit(127);
  }
  return process;
}

/// The exit code; -1: it was killed.
int wait_for(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class Resume : public OwnFolder {
 protected:
  std::string unbroken() const { return folder() + "/unbroken"; }
  std::string cut() const { return folder() + "/cut"; }

  static int run(std::vector<std::string> arguments, const std::string& out) {
    arguments.insert(arguments.end(), {"--out", out});
    return wait_for(launch(arguments));
  }

  /// Kills a run once its journal has grown by so many bytes; false: it ended before.
  bool kill_after(const std::vector<std::string>& arguments, std::uintmax_t bytes) const {
    return end_after(arguments, bytes, SIGKILL) == -1;
  }

  /// Sends a signal to a run once its journal has grown by so many bytes. Its exit code, -1: it was killed; none: it
  /// ended before.
  std::optional<int> end_after(const std::vector<std::string>& arguments, std::uintmax_t bytes, int by) const {
    const fs::path journal = cut() + "/journal";
    std::error_code error;
    const auto size = [&] {
      const std::uintmax_t now = fs::file_size(journal, error);
      return error ? std::uintmax_t{0} : now;
    };
    // A run that is taken up cuts the journal back first: it has grown where it has grown from its least.
    std::uintmax_t least = size();
    const pid_t process = launch(arguments);
    for (;;) {
      int status = 0;
      if (waitpid(process, &status, WNOHANG) == process) return std::nullopt;
      const std::uintmax_t now = size();
      least = std::min(least, now);
      if (now >= least + bytes) break;
      usleep(500);
    }
    kill(process, by);
    return wait_for(process);
  }

  void expect_same_files() const {
    EXPECT_EQ(files_of(cut()), files_of(unbroken()));
    for (const std::string& name : files_of(unbroken())) {
      if (name == "result.yaml") continue;
      EXPECT_TRUE(text_of(cut() + "/" + name) == text_of(unbroken() + "/" + name)) << name;
    }
    const std::regex of_this_run("(wall_time|real_time_factor|peak_memory): [^\n]*\n");
    const auto result = [&](const std::string& run) {
      return std::regex_replace(text_of(run + "/result.yaml"), of_this_run, "");
    };
    EXPECT_EQ(result(cut()), result(unbroken()));
  }

  std::vector<std::string> in_cut(std::vector<std::string> more) const {
    std::vector<std::string> out = kTest;
    out.insert(out.end(), {"--out", cut()});
    out.insert(out.end(), more.begin(), more.end());
    return out;
  }
  std::vector<std::string> resumed(const std::string& checkpoint) const {
    return {"--resume", cut(), "--quiet", "--checkpoint", checkpoint};
  }
};

TEST_F(Resume, KilledAgainAndAgainItLeavesTheSameFiles) {
  ASSERT_EQ(run(kTest, unbroken()), 0);
  constexpr std::uintmax_t kSomeRecords = 40000;
  std::mt19937 random(7);
  std::uniform_int_distribution<std::uintmax_t> bytes(1, 60000);
  ASSERT_TRUE(kill_after(in_cut({"--checkpoint", "1e-6"}), kSomeRecords));
  int killed = 1;
  while (killed < 8 && kill_after(resumed("1e-6"), bytes(random))) {
    ++killed;
    EXPECT_TRUE(fs::exists(cut() + "/checkpoint"));
    EXPECT_FALSE(fs::exists(cut() + "/result.yaml"));
  }
  EXPECT_GE(killed, 4);
  ASSERT_EQ(wait_for(launch(resumed("1e-6"))), 0);
  expect_same_files();
}

TEST_F(Resume, WithoutACheckpointItBeginsAnew) {
  ASSERT_EQ(run(kTest, unbroken()), 0);
  ASSERT_TRUE(kill_after(in_cut({"--checkpoint", "0"}), 20000));
  EXPECT_FALSE(fs::exists(cut() + "/checkpoint"));
  EXPECT_TRUE(fs::exists(cut() + "/journal"));
  ASSERT_EQ(wait_for(launch(resumed("0"))), 0);
  expect_same_files();
}

TEST_F(Resume, InterruptedAgainAndAgainItLeavesWhatWasMeasuredAndThenTheSameFiles) {
  ASSERT_EQ(run(kTest, unbroken()), 0);
  const auto expect_interrupted = [&] {
    EXPECT_THAT(text_of(cut() + "/result.yaml"), HasSubstr("ended_by: operator\nreason: \"interrupted\"\n"));
    for (const char* name : {"/journal", "/checkpoint", "/curve.csv", "/final_shape.csv"})
      EXPECT_TRUE(fs::exists(cut() + name)) << name;
    EXPECT_EQ(text_of(unbroken() + "/curve_full.csv").find(text_of(cut() + "/curve_full.csv")), 0u);
  };
  // Checkpoints that never fall due: that of the interruption is the only one.
  ASSERT_EQ(end_after(in_cut({"--checkpoint", "1e6"}), 60000, SIGINT), 1);
  expect_interrupted();
  // On a slow machine it may come to its end before the signal does.
  if (end_after(resumed("1e6"), 20000, SIGTERM) == 1) {
    expect_interrupted();
    ASSERT_EQ(wait_for(launch(resumed("1e6"))), 0);
  }
  expect_same_files();
}

TEST_F(Resume, InterruptedWithoutACheckpointItBeginsAnew) {
  ASSERT_EQ(run(kTest, unbroken()), 0);
  ASSERT_EQ(end_after(in_cut({"--checkpoint", "0"}), 60000, SIGINT), 1);
  EXPECT_FALSE(fs::exists(cut() + "/checkpoint"));
  ASSERT_EQ(wait_for(launch(resumed("0"))), 0);
  expect_same_files();
}

TEST_F(Resume, WhatWasInterruptedIsLostNeitherToANewRunNorToARecovery) {
  ASSERT_EQ(run(kTest, unbroken()), 0);
  ASSERT_EQ(end_after(in_cut({}), 60000, SIGINT), 1);
  const Answer recovered = answer_of(tool("recover", "'" + cut() + "'"));
  EXPECT_EQ(recovered.code, 0);
  EXPECT_THAT(recovered.text, HasSubstr("--resume"));
  ASSERT_EQ(run({"straight", "--set", "program=[{hold: {duration: 0.1}}]", "--quiet"}, cut()), 0);
  EXPECT_TRUE(fs::exists(cut() + "-2/result.yaml"));
  ASSERT_EQ(wait_for(launch(resumed("5"))), 0);
  expect_same_files();
}

/// What tensile_test says in its one line about wrong input.
std::string complaint(const std::string& arguments) {
  const Answer answer = answer_of(tool("tensile_test", arguments));
  EXPECT_EQ(answer.code, 2) << arguments;
  EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << arguments << "\n" << answer.text;
  return answer.text;
}

TEST_F(Resume, IsRefusedWhileTheTestGoesOnAndDisturbsNothing) {
  ASSERT_EQ(run(kTest, unbroken()), 0);
  const fs::path journal = cut() + "/journal";
  std::error_code error;
  const pid_t process = launch(in_cut({"--checkpoint", "1e-6"}));
  while (kill(process, 0) == 0 && (!fs::exists(journal, error) || fs::file_size(journal, error) < 40000)) usleep(500);
  // It stands still, so that it goes on for certain, and whatever is changed was not changed by it.
  kill(process, SIGSTOP);
  siginfo_t stopped{};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(process), &stopped, WSTOPPED | WEXITED | WNOWAIT), 0);
  ASSERT_EQ(stopped.si_code, CLD_STOPPED) << "the test was over before it could be stopped";
  const auto contents = [&] {
    std::map<std::string, std::string> all;
    for (const std::string& name : files_of(cut())) all[name] = text_of(cut() + "/" + name);
    return all;
  };
  const auto before = contents();
  EXPECT_THAT(complaint("--resume '" + cut() + "'"), HasSubstr(": its test is still running"));
  EXPECT_TRUE(contents() == before);
  kill(process, SIGCONT);
  ASSERT_EQ(wait_for(process), 0);
  expect_same_files();
}

TEST_F(Resume, RefusesInOneLineWhatCannotBeTakenUp) {
  // Several records, the largest of which is a small part of them: the checkpoint stands before the last one.
  ASSERT_TRUE(kill_after(in_cut({"--checkpoint", "1e-6"}), 60000));
  const std::string resume = "--resume '" + cut() + "'";
  EXPECT_THAT(complaint(resume + " " + kTest[0]), HasSubstr("METHOD and --resume cannot be given together"));
  EXPECT_THAT(complaint(resume + " --checkpoint -1"), HasSubstr("--checkpoint"));

  const auto changed = [&](const std::string& name, auto change) {
    const std::string file = cut() + "/" + name, whole = text_of(file);
    std::string bytes = whole;
    change(bytes);
    std::ofstream(file, std::ios::binary) << bytes;
    const std::string said = complaint(resume);
    std::ofstream(file, std::ios::binary) << whole;
    return said;
  };
  const auto cut_off = [](std::string& bytes) { bytes.resize(bytes.size() - 1); };
  EXPECT_THAT(changed("checkpoint", cut_off), HasSubstr("the checkpoint cannot be loaded: length: "));
  EXPECT_THAT(changed("checkpoint", [](std::string& bytes) { bytes[bytes.size() / 2] ^= 1; }),
              HasSubstr("the checkpoint cannot be loaded: checksum: "));
  EXPECT_THAT(changed("checkpoint", [](std::string& bytes) { bytes = "x,y,z\n"; }),
              HasSubstr("the checkpoint cannot be loaded: first line: found that of a foreign file"));
  EXPECT_THAT(changed("method.yaml",
                      [](std::string& text) {
                        text = std::regex_replace(text, std::regex("capacity: 50000"), "capacity: 40000");
                      }),
              HasSubstr("journal: the journal belongs to another method than method.yaml"));
  EXPECT_THAT(changed("journal", [](std::string& bytes) { bytes.resize(bytes.size() / 8); }),
              HasSubstr("checkpoint: the checkpoint needs "));
  EXPECT_THAT(changed("journal", [](std::string& bytes) { bytes = "x,y,z\n"; }), HasSubstr("journal: "));

  ASSERT_EQ(wait_for(launch(resumed("0"))), 0);
  EXPECT_THAT(complaint(resume), HasSubstr("has ended"));
  EXPECT_THAT(complaint("--resume '" + folder() + "/nowhere'"), HasSubstr("nowhere/method.yaml"));
}

}  // namespace
}  // namespace knot_utm
