#include "knot_utm/run/run_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <fstream>

#include "knot_utm/contact/centreline_curve.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/topology/knot_hole.hpp"
#include "program/programs.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::string kConfig = std::string(KNOT_UTM_SOURCE_DIR) + "/config/";

class RunFolder : public OwnFolder {
 protected:
  void begin(const Method& method) {
    make_folder(folder(), "--out");
    begin_run_folder(folder(), method);
  }

  /// The files of some records, as if they were those of a whole test.
  RunFacts make(const Method& method, const std::vector<Record>& records, const TestEnd& end, const Points& shape) {
    begin(method);
    SamplesWriter samples(folder());
    for (const Record& record : records) samples.append(record);
    samples.end(end, shape);
    return make_results(folder(), method, {}).facts;
  }

  /// A whole run of the method with a spring for a knot.
  void run(const Method& method, FakeBench bench = {}) {
    ProgramRunner program(method.program, method.machine.load_cell.sampling_rate, 0.1, {});
    std::vector<Record> records;
    run_test(bench, program, [&](const Command& command, const Sample& sample) {
      Sample half_way = sample;
      half_way.time -= 0.04;
      records.push_back({command, sample, {half_way, sample}, {}, {}, {}, 0.5});
    });
    make(method, records, {program.ended_by(), program.reason()}, Points::Zero(3, 4));
  }
  YAML::Node result() const { return YAML::LoadFile(in("result.yaml")); }
};

/// Of the last shape, with the centreline by which its strands touch.
TEST_F(RunFolder, HoldsTheInnerDiameterOfAKnotThatIsWhole) {
  const Method method = load_method(kConfig + "overhand.yaml");
  const Points shape = knot_of(method.specimen).centreline(method.specimen, method.material, {}).points;
  Record pulled, held;
  pulled.answer.time = 1.0;
  pulled.answer.phase = Phase::kPull;
  held.answer.time = 2.0;
  held.answer.phase = Phase::kHold;
  const TestEnd end{EndedBy::kProgram, ""};
  make(method, {pulled}, end, shape);
  EXPECT_TRUE(result()["knotability"].IsNull()) << "nothing rests";
  make(method, {pulled, held}, end, shape);
  const double hole = hole_diameter(sampled_centreline(shape), method.material.radius);
  EXPECT_GT(hole, 4.0 * method.material.radius);  // it is drawn loose
  const double rounding = 1e-13 * hole;           // the compiler fuses products of this test's copy in another way
  EXPECT_NEAR(result()["knot_inner_diameter"].as<double>(), hole, rounding);
  EXPECT_NEAR(result()["knotability"].as<double>() * 2.0 * method.material.radius, hole, rounding);
  held.answer.break_place = BreakPlace::kStrand;
  make(method, {pulled, held}, end, shape);
  EXPECT_TRUE(result()["knotability"].IsNull());
}

TEST_F(RunFolder, CurveHasTheSamplingInstantsAndTheFullCurveEveryStep) {
  run(load_method(kConfig + "tighten.yaml"));
  std::vector<CurveRow> curve = read_curve(in("curve.csv"));
  curve.pop_back();  // the end of the pull, a reading wherever it lies
  std::size_t sampled = 0, balanced = 0;
  for (const CurveRow& row : curve) {
    if (row.phase == Phase::kBalance && row.time != static_cast<double>(sampled * 4) / 12.0)
      ++balanced;
    else
      EXPECT_EQ(row.time, static_cast<double>(sampled++ * 4) / 12.0);
  }
  EXPECT_EQ(balanced, 1u);
  const std::vector<CurveRow> full = read_curve(in("curve_full.csv"));
  EXPECT_GE(full.size(), 8 * (sampled - 1) + 1);
  for (std::size_t i = 1; i < full.size(); ++i) EXPECT_GT(full[i].time, full[i - 1].time);
}

TEST_F(RunFolder, ItsMethodRunsAgainToTheSameBytes) {
  run(load_method(kConfig + "from_file.yaml"));
  const std::string curve = read_whole(in("curve.csv"));
  const std::string method = read_whole(in("method.yaml"));
  EXPECT_THAT(method, HasSubstr("file: specimen.csv"));
  run(load_method(in("method.yaml")));
  EXPECT_EQ(read_whole(in("curve.csv")), curve);
  EXPECT_EQ(read_whole(in("method.yaml")), method);
}

TEST_F(RunFolder, KeepsTheKnotThatAUsersFileDescribes) {
  fs::create_directories(folder());
  const std::string own = in("mine.yaml");
  fs::copy_file(kConfig + "knots/reef.yaml", own);
  begin_run_folder(folder(), load_method(kConfig + "knot.yaml", {"specimen.knot=" + own}));
  const std::string method = read_whole(in("method.yaml"));
  EXPECT_THAT(method, HasSubstr("knot: knot.yaml"));
  EXPECT_EQ(read_whole(in("knot.yaml")), read_whole(own));
  fs::remove(own);
  begin_run_folder(folder(), load_method(in("method.yaml")));
  EXPECT_EQ(read_whole(in("method.yaml")), method);
}

TEST_F(RunFolder, ARunThatGaveUpKeepsWhatItHadAndTheReason) {
  FakeBench bench;
  bench.fail_time = 8.0;
  run(load_method(kConfig + "tighten.yaml"), bench);
  const YAML::Node made = result();
  EXPECT_EQ(made["ended_by"].as<std::string>(), "solver");
  EXPECT_THAT(made["reason"].as<std::string>(), HasSubstr("converged"));
  EXPECT_GT(read_curve(in("curve.csv")).size(), 20u);
}

TEST_F(RunFolder, AnUnfinishedRunHasNoResultOfAnEarlierOne) {
  const Method method = load_method(kConfig + "straight.yaml");
  run(method);
  EXPECT_TRUE(fs::exists(in("result.yaml")));
  begin(method);
  EXPECT_FALSE(fs::exists(in("result.yaml")));
  EXPECT_FALSE(fs::exists(in("final_shape.csv")));
}

TEST_F(RunFolder, ARunMayTestTheShapeThatTheLastOneLeftThere) {
  fs::create_directories(folder());
  const std::string shape = "x,y,z\nm,m,m\n0,0,0\n0,0,0.1\n0,0,0.2\n0,0,0.3\n";
  std::ofstream(in("final_shape.csv")) << shape;
  Method method = load_method(kConfig + "from_file.yaml");
  method.specimen.file = in("final_shape.csv");
  begin(method);
  EXPECT_EQ(read_whole(in("specimen.csv")), shape);
  EXPECT_FALSE(fs::exists(in("final_shape.csv")));
}

}  // namespace
}  // namespace knot_utm
