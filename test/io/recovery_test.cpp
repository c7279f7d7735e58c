#include "knot_utm/io/recovery.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "io/own_folder.hpp"
#include "knot_utm/io/run_folder.hpp"
#include "knot_utm/machine/run_test.hpp"
#include "machine/fake_bench.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string kStraight = std::string(KNOT_UTM_SOURCE_DIR) + "/config/straight.yaml";

class RecoveryOf : public OwnFolder {
 protected:
  std::string in(const char* name) const { return folder() + "/" + name; }

  /// A run with a spring for a specimen, dead after so many commands if not at its end.
  void run(const std::string& out, std::uint64_t dies_after, const std::string& test = "") const {
    FakeBench bench;
    ProgramRunner program(method_.program, method_.machine.load_cell.sampling_rate, 0.1, {});
    JournalWriter journal(out, journal_header(method_, test));
    RunWriter writer(out, method_);
    Record record;
    run_test(bench, program, [&](const Command& command, const Sample& sample) {
      if (command.sequence >= dies_after) return program.stop();
      record.command = command;
      record.answer = sample;
      record.steps = bench.substeps;
      record.shape = Points::Constant(3, 4, command.time);
      record.readings = RodReadings{{}, Eigen::VectorXd::Constant(4, command.time)};
      record.wall_time = 0.5;
      journal.append(record);
      writer.add(record);
    });
    if (program.ended_by() == EndedBy::kOperator) return;
    writer.finish(writer.results(program.ended_by()), writer.facts(), record.shape);
    journal.remove();
  }

  static std::string recover(const std::string& from, const std::string& to) {
    Recovery recovery(from, to);
    Record record;
    while (recovery.next(record)) {
    }
    recovery.finish();
    return recovery.summary();
  }

  /// What refuses to recover says.
  static std::string refusal(const std::string& from, const std::string& to) {
    try {
      recover(from, to);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  const Method method_ = load_method(kStraight);
};

constexpr std::uint64_t kNever = 1u << 20u;

TEST_F(RecoveryOf, ARunThatDiedBeforeItsResultIsThatOfAnUnbrokenRunToTheByte) {
  run(in("unbroken"), kNever);
  run(in("killed"), kNever);
  // The journal as it was before all was complete.
  {
    FakeBench bench;
    ProgramRunner program(method_.program, method_.machine.load_cell.sampling_rate, 0.1, {});
    JournalWriter journal(in("killed"), journal_header(method_));
    run_test(bench, program, [&](const Command& command, const Sample& sample) {
      Record record;
      record.command = command;
      record.answer = sample;
      record.steps = bench.substeps;
      record.shape = Points::Constant(3, 4, command.time);
      record.readings = RodReadings{{}, Eigen::VectorXd::Constant(4, command.time)};
      journal.append(record);
    });
  }
  for (const char* name : {"curve.csv", "curve_full.csv", "final_shape.csv", "shapes.csv", "result.yaml"}) {
    fs::remove(in("killed") + "/" + name);
  }
  recover(in("killed"), in("killed"));
  for (const char* name : {"curve.csv", "curve_full.csv", "final_shape.csv", "shapes.csv", "method.yaml"}) {
    EXPECT_EQ(read_whole(in("killed") + "/" + name), read_whole(in("unbroken") + "/" + name)) << name;
  }
}

TEST_F(RecoveryOf, ARunThatDiedMidwayHasWhatItMeasured) {
  run(in("unbroken"), kNever);
  run(in("killed"), 7);
  // Killed in the midst of a record.
  std::ofstream(journal_file(in("killed")), std::ios::app) << "half a record";
  EXPECT_THAT(recover(in("killed"), in("killed")), HasSubstr("7 commands of the test were written to"));
  for (const char* name : {"curve.csv", "curve_full.csv"}) {
    EXPECT_THAT(read_whole(in("unbroken") + "/" + name), StartsWith(read_whole(in("killed") + "/" + name))) << name;
  }
  EXPECT_GT(read_curve(in("killed") + "/curve_full.csv").size(), 7u);
  const std::string result = read_whole(in("killed") + "/result.yaml");
  EXPECT_THAT(
      result,
      HasSubstr("ended_by: not yet\nreason: \"the program was killed\"\nwarnings: [\"these results were rebuilt"));
  EXPECT_THAT(result, HasSubstr("wall_time: 0.5\n"));
  EXPECT_THAT(result, HasSubstr("peak_memory: null  # not known\n"));
}

TEST_F(RecoveryOf, ARecordersRunSaysThatTheRecorderDied) {
  run(folder(), 3, "launch/1");
  recover(folder(), folder());
  EXPECT_THAT(read_whole(in("result.yaml")), HasSubstr("reason: \"the recorder died\""));
}

TEST_F(RecoveryOf, ARunThatDiedBeforeItsFirstAnswer) {
  run(folder(), 0);
  recover(folder(), folder());
  EXPECT_THAT(read_whole(in("result.yaml")), HasSubstr("ended_by: not yet"));
}

TEST_F(RecoveryOf, ASecondTimeGivesTheSameAndTheJournalStays) {
  run(folder(), 7);
  const std::string journal = read_whole(journal_file(folder()));
  recover(folder(), folder());
  const std::string result = read_whole(in("result.yaml"));
  EXPECT_FALSE(is_settled(folder()));
  recover(folder(), folder());
  EXPECT_EQ(read_whole(in("result.yaml")), result);
  EXPECT_EQ(read_whole(journal_file(folder())), journal);
}

TEST_F(RecoveryOf, ACompleteRunIsLeftAloneButForTheJournal) {
  run(folder(), kNever);
  const std::string result = read_whole(in("result.yaml"));
  { const JournalWriter left_over(folder(), journal_header(method_)); }
  EXPECT_TRUE(is_settled(folder()));
  EXPECT_FALSE(fs::exists(journal_file(folder())));
  EXPECT_EQ(read_whole(in("result.yaml")), result);
}

TEST_F(RecoveryOf, ARunElsewhereChangesNothingWhereItWas) {
  run(in("killed"), 7);
  fs::remove(in("killed/curve.csv"));
  recover(in("killed"), in("other"));
  EXPECT_FALSE(fs::exists(in("killed/curve.csv")));
  EXPECT_TRUE(fs::exists(in("other/curve.csv")));
  EXPECT_THAT(refusal(in("other"), in("other")), HasSubstr("cannot read "));
}

TEST_F(RecoveryOf, AFailedStepIsThereAsItWas) {
  run(in("killed"), 7);
  write_whole(failed_step_file(in("killed")), "step");
  recover(in("killed"), in("killed"));
  recover(in("killed"), in("other"));
  EXPECT_EQ(read_whole(in("killed/failed_step.bin")), "step");
  EXPECT_EQ(read_whole(in("other/failed_step.bin")), "step");
}

TEST_F(RecoveryOf, IsRefusedOverAnotherRunsJournal) {
  run(in("killed"), 7);
  run(in("other"), 5);
  EXPECT_THAT(refusal(in("killed"), in("other")), HasSubstr("holds a run already: choose another folder"));
}

TEST_F(RecoveryOf, IsRefusedWhileTheRunGoesOn) {
  run(folder(), 7);
  const JournalWriter alive = JournalWriter::go_on(folder(), 0.0);
  EXPECT_THAT(refusal(folder(), folder()), HasSubstr("a run is still writing "));
  EXPECT_FALSE(fs::exists(in("result.yaml")));
}

TEST_F(RecoveryOf, IsRefusedForAnotherMethod) {
  run(folder(), 7);
  std::ofstream(in("method.yaml"), std::ios::app) << "# changed\n";
  EXPECT_THAT(refusal(folder(), folder()), HasSubstr("the journal belongs to another method than "));
}

/// A file that may not grow stands for a disk that is full.
TEST_F(RecoveryOf, WithoutRoomChangesNothing) {
  run(folder(), 20);
  const std::string curve = read_whole(in("curve_full.csv"));
  const rlim_t method = fs::file_size(in("method.yaml"));
  ASSERT_GT(curve.size(), method + 10);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const rlim_t most : {method / 2, method + 10}) {
    rlimit tight = before;
    tight.rlim_cur = most;
    setrlimit(RLIMIT_FSIZE, &tight);
    const std::string why = refusal(folder(), folder());
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_THAT(why, HasSubstr("file too large"));
    EXPECT_EQ(read_whole(in("curve_full.csv")), curve);
    EXPECT_FALSE(fs::exists(in("recovering")));
    EXPECT_FALSE(fs::exists(in("result.yaml")));
  }
  std::signal(SIGXFSZ, handler);
}

}  // namespace
}  // namespace knot_utm
