#include "knot_utm/run/samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <regex>
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
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

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
    out.command = {sequence,     number(), number(), number(), number(),          static_cast<int>(sequence % 5) - 1,
                   Phase::kPull, number(), number(), number(), sequence % 2 == 0, sequence % 2 == 1};
    out.answer = sample(sequence);
    for (std::uint64_t k = 0; k < sequence % 4; ++k) out.steps.push_back(sample(sequence));
    if (sequence % 4 == 2) out.answer = out.steps.back();
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
  static std::string shapes() { return read_whole(in("shapes.bin")); }

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
  EXPECT_THAT(rows(), HasSubstr("\nanswered step,")) << "once, and not as a step and as an answer";
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
    write_whole(in("shapes.bin"), bad_shapes);
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
    EXPECT_THAT(read_whole(samples_file(out)), HasSubstr("\nanswered step,"));
    const std::string samples = read_whole(samples_file(out)), curve = read_whole(out + "/curve_full.csv");
    const auto steps = std::count(curve.begin(), curve.end(), '\n');
    const std::regex step("\n(answered )?step,");
    const auto answered = samples.rfind("\nanswer", samples.rfind('\n') - 1);  // of the last row that is whole
    const auto end = samples.begin() + static_cast<std::ptrdiff_t>(samples.find('\n', answered + 1));
    const auto written = 2 + std::distance(std::sregex_iterator(samples.begin(), end, step), {});
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
  ASSERT_EQ(shell(kTest + in("run") + " --shapes"), 0);
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
