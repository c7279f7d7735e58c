#include "knot_utm/io/journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>
#include <vector>

#include "io/own_folder.hpp"
#include "knot_utm/io/run_folder.hpp"
#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr double Sample::*kNumbers[] = {&Sample::time,
                                        &Sample::displacement,
                                        &Sample::extension,
                                        &Sample::end_to_end,
                                        &Sample::knot_distance,
                                        &Sample::load,
                                        &Sample::balance_offset,
                                        &Sample::force_upper,
                                        &Sample::force_lower,
                                        &Sample::max_penetration,
                                        &Sample::normal_force,
                                        &Sample::fastest_node,
                                        &Sample::stretching_energy,
                                        &Sample::bending_energy,
                                        &Sample::twisting_energy,
                                        &Sample::contact_energy,
                                        &Sample::kinetic_energy,
                                        &Sample::grip_work,
                                        &Sample::dissipation,
                                        &Sample::friction_loss,
                                        &Sample::plastic_loss,
                                        &Sample::numerical_dissipation,
                                        &Sample::reweighting_loss,
                                        &Sample::moment_imbalance,
                                        &Sample::knots_force,
                                        &Sample::knot_on_roller,
                                        &Sample::raw_extension};

/// No two numbers are the same; some are those that are easily lost.
Sample sample(std::uint64_t sequence) {
  Sample s;
  s.sequence = sequence;
  double value = 1.0 / 3.0;
  for (const auto number : kNumbers) s.*number = value += static_cast<double>(sequence + 1);
  s.extension = -0.0;
  s.end_to_end = std::numeric_limits<double>::denorm_min();
  s.knot_distance = Sample::kNone;
  s.balance_offset = 1e-300;
  s.force_upper = -1.0;
  s.force_lower = std::numeric_limits<double>::infinity();
  s.phase = Phase::kPull;
  s.tail_force = {Sample::kNone, 70.0};
  s.excess_length = {0.02};
  s.contacts = 11;
  s.steps = 1u << 31u;
  s.rejected_steps = 3;
  s.newton_iterations = std::numeric_limits<std::uint64_t>::max();
  s.knot_type = KnotType::kCrossed;
  s.status = BenchStatus::kFailed;
  s.message = "no step converged";
  return s;
}

Record record(std::uint64_t sequence) {
  Record r;
  r.command.sequence = sequence;
  r.command.time = 0.1 * static_cast<double>(sequence);
  r.command.displacement = 0.003;
  r.command.velocity = -0.0033;
  r.command.step = -1;
  r.command.phase = Phase::kHold;
  r.command.speed = 0.01;
  r.command.duration = 2.0;
  r.command.balance = true;
  r.command.read_cell = sequence % 2 == 0;
  r.answer = sample(sequence);
  r.steps = {sample(sequence), sample(sequence)};
  if (shape_is_due(r.command, r.answer)) {
    r.shape = Points::Random(3, 5);
    r.tension = Eigen::VectorXd::Random(4);
  }
  r.wall_time = 12.5;
  return r;
}

/// The same bits, which == would not say of NaN and -0.
bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same(const PerKnot& a, const PerKnot& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) { return same(x, y); });
}

void expect_same(const Sample& a, const Sample& b) {
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.phase, b.phase);
  EXPECT_EQ(a.contacts, b.contacts);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.rejected_steps, b.rejected_steps);
  EXPECT_EQ(a.newton_iterations, b.newton_iterations);
  EXPECT_EQ(a.knot_type, b.knot_type);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.message, b.message);
  for (const auto number : kNumbers) EXPECT_TRUE(same(a.*number, b.*number)) << a.*number << " " << b.*number;
  EXPECT_TRUE(same(a.tail_force, b.tail_force));
  EXPECT_TRUE(same(a.excess_length, b.excess_length));
}

void expect_same(const Record& a, const Record& b) {
  EXPECT_EQ(a.command.sequence, b.command.sequence);
  EXPECT_EQ(a.command.time, b.command.time);
  EXPECT_EQ(a.command.displacement, b.command.displacement);
  EXPECT_EQ(a.command.velocity, b.command.velocity);
  EXPECT_EQ(a.command.step, b.command.step);
  EXPECT_EQ(a.command.phase, b.command.phase);
  EXPECT_EQ(a.command.speed, b.command.speed);
  EXPECT_EQ(a.command.duration, b.command.duration);
  EXPECT_EQ(a.command.balance, b.command.balance);
  EXPECT_EQ(a.command.read_cell, b.command.read_cell);
  expect_same(a.answer, b.answer);
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i) expect_same(a.steps[i], b.steps[i]);
  EXPECT_EQ(a.shape, b.shape);
  EXPECT_EQ(a.tension, b.tension);
  EXPECT_EQ(a.wall_time, b.wall_time);
}

class Journal : public OwnFolder {
 protected:
  static JournalHeader header() {
    JournalHeader h;
    h.method = "specimen: {knot: straight}\n";
    h.specimen = 0xfedcba98u;
    h.test = "launch/1";
    return h;
  }

  /// A journal of `records` records; the end of each, that of the header first.
  std::vector<std::uint64_t> write(std::uint64_t records) const {
    JournalWriter writer(folder(), header());
    std::vector<std::uint64_t> ends = {writer.bytes()};
    for (std::uint64_t i = 0; i < records; ++i) {
      writer.append(records_[i]);
      ends.push_back(writer.bytes());
    }
    return ends;
  }

  /// Reads to the end; how many records there were.
  static std::uint64_t read(JournalReader& reader) {
    Record r;
    while (reader.next(r)) {
    }
    return reader.records();
  }

  std::string invalid() const {
    try {
      const JournalReader reader(folder());
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  }

  std::string bytes() const { return read_whole(journal_file(folder())); }
  void put(const std::string& all) const { write_whole(journal_file(folder()), all); }

  const std::vector<Record> records_ = {record(0), record(1), record(2)};
};

TEST_F(Journal, GivesBackEveryBit) {
  write(3);
  JournalReader reader(folder());
  EXPECT_TRUE(reader.header().same_run(header()));
  EXPECT_EQ(reader.header().test, header().test);
  for (const Record& written : records_) {
    Record r = record(7);
    ASSERT_TRUE(reader.next(r));
    expect_same(r, written);
  }
  Record r;
  EXPECT_FALSE(reader.next(r));
  EXPECT_EQ(reader.bytes_left(), 0u);
}

TEST_F(Journal, TellsItsLengthAfterEachRecord) {
  const std::vector<std::uint64_t> ends = write(3);
  EXPECT_EQ(ends.back(), fs::file_size(journal_file(folder())));
  JournalReader reader(folder());
  Record r;
  for (const std::uint64_t end : ends) {
    EXPECT_EQ(reader.good_bytes(), end);
    reader.next(r);
  }
}

TEST_F(Journal, IsThereForOthersOnceAppendReturns) {
  JournalWriter writer(folder(), header());
  for (std::uint64_t i = 0; i < 3; ++i) {
    writer.append(records_[i]);
    JournalReader reader(folder());
    EXPECT_EQ(read(reader), i + 1);
  }
}

TEST_F(Journal, CutAtAnyByteOfTheLastRecordItHasThoseBefore) {
  const std::vector<std::uint64_t> ends = write(3);
  const std::string all = bytes();
  for (std::uint64_t cut = ends[2]; cut < ends[3]; ++cut) {
    put(all.substr(0, cut));
    JournalReader reader(folder());
    ASSERT_EQ(read(reader), 2u) << cut;
    ASSERT_EQ(reader.good_bytes(), ends[2]) << cut;
    ASSERT_EQ(reader.bytes_left(), cut - ends[2]);
  }
}

TEST_F(Journal, BehindAFlippedBitNothingIsBelieved) {
  const std::vector<std::uint64_t> ends = write(3);
  const std::string all = bytes();
  for (std::uint64_t place = ends[1]; place < ends[2]; ++place) {
    std::string damaged = all;
    damaged[place] = static_cast<char>(damaged[place] ^ (1 << (place % 8)));
    put(damaged);
    JournalReader reader(folder());
    ASSERT_EQ(read(reader), 1u) << place;
    ASSERT_EQ(reader.bytes_left(), ends[3] - ends[1]);
    Record r;
    ASSERT_FALSE(reader.next(r));
  }
}

TEST_F(Journal, ZerosAtTheEndAreNoRecord) {
  const std::vector<std::uint64_t> ends = write(3);
  put(bytes() + std::string(4096, '\0'));
  JournalReader reader(folder());
  EXPECT_EQ(read(reader), 3u);
  EXPECT_EQ(reader.good_bytes(), ends[3]);
  EXPECT_EQ(reader.bytes_left(), 4096u);
}

TEST_F(Journal, CutAtAnyByteOfTheHeaderItIsNone) {
  const std::uint64_t end = write(0)[0];
  const std::string all = bytes();
  for (std::uint64_t cut = 0; cut < end; ++cut) {
    put(all.substr(0, cut));
    ASSERT_THAT(invalid(), HasSubstr(journal_file(folder()))) << cut;
  }
}

TEST_F(Journal, RefusesAForeignFile) {
  fs::create_directories(folder());
  put("time,extension,load\ns,m,N\n0,0,0\n");
  EXPECT_THAT(invalid(), HasSubstr("the file is no journal of knot_utm"));
  fs::remove_all(folder());
  EXPECT_THAT(invalid(), HasSubstr("cannot read "));
}

TEST_F(Journal, RefusesAnotherVersion) {
  write(1);
  std::string all = bytes();
  all[all.find('\n') + 1] = 1;
  put(all);
  EXPECT_THAT(invalid(), HasSubstr("the journal's version is 1, but must be"));
}

TEST_F(Journal, GoesOnFromARecord) {
  const std::vector<std::uint64_t> ends = write(3);
  const std::string all = bytes();
  {
    JournalWriter writer = JournalWriter::go_on(folder(), 0.0);
    EXPECT_EQ(writer.bytes(), ends[3]);
    writer.truncate_to(ends[1]);
    EXPECT_EQ(writer.bytes(), ends[1]);
    writer.append(records_[1]);
    writer.append(records_[2]);
  }
  EXPECT_EQ(bytes(), all);
}

TEST_F(Journal, BeginsAnewWhereOneIs) {
  write(3);
  const std::string all = bytes();
  write(1);
  EXPECT_LT(bytes().size(), all.size());
  JournalReader reader(folder());
  EXPECT_EQ(read(reader), 1u);
}

TEST_F(Journal, HasOneWriterAtATime) {
  JournalWriter writer(folder(), header());
  writer.append(records_[0]);
  EXPECT_THROW(JournalWriter(folder(), header()), InvalidInput);
  EXPECT_THROW(JournalWriter::go_on(folder(), 0.0), std::runtime_error);
  JournalReader reader(folder());
  EXPECT_EQ(read(reader), 1u);
}

TEST_F(Journal, RemovedItIsWrittenNoMore) {
  JournalWriter writer(folder(), header());
  fs::remove_all(folder());
  EXPECT_THROW(writer.append(records_[0]), std::runtime_error);
}

/// A file that may not grow stands for a disk that is full: the system refuses both in the midst of a write.
TEST_F(Journal, WithoutRoomItEndsWithTheRecordBefore) {
  const std::vector<std::uint64_t> ends = write(2);
  JournalWriter writer = JournalWriter::go_on(folder(), 0.0);
  writer.truncate_to(ends[1]);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit tight = before;
  tight.rlim_cur = ends[2] - 1;
  setrlimit(RLIMIT_FSIZE, &tight);
  std::string why;
  try {
    writer.append(records_[1]);
  } catch (const std::runtime_error& error) {
    why = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(why, "cannot write " + journal_file(folder()) + ": file too large");
  EXPECT_EQ(fs::file_size(journal_file(folder())), ends[1]);
  writer.append(records_[1]);
  JournalReader reader(folder());
  EXPECT_EQ(read(reader), 2u);
}

TEST_F(Journal, HeaderTellsMethodsApart) {
  Method method;
  const JournalHeader plain = journal_header(method, "a");
  EXPECT_TRUE(plain.same_run(journal_header(method, "a")));
  EXPECT_TRUE(plain.same_run(journal_header(method, "b"))) << "whoever runs it has the same records";
  method.material.radius += 1e-6;
  EXPECT_FALSE(plain.same_run(journal_header(method, "a")));
  fs::create_directories(folder());
  method.specimen.knot = knot_named("file");
  method.specimen.file = folder() + "/shape.csv";
  write_whole(method.specimen.file, "x,y,z\nm,m,m\n0,0,0\n");
  const JournalHeader shape = journal_header(method, "a");
  write_whole(method.specimen.file, "x,y,z\nm,m,m\n0,0,1\n");
  EXPECT_FALSE(shape.same_run(journal_header(method, "a")));
}

}  // namespace
}  // namespace knot_utm
