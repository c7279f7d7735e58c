// What rviz shows of a test, by the camera of config/knot_utm.rviz: without rviz, and without a display.
#include "knot_utm/ros/views.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

#include "knot_utm/machine/run_test.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/ros/markers.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/run/load_test.hpp"

namespace knot_utm {
namespace {

std::string config(const std::string& file) { return std::string(KNOT_UTM_SOURCE_DIR) + "/config/" + file; }

struct Case {
  const char* method;
  std::vector<std::string> overrides;
};

void expect_in_picture(const Vec3& eye, const Vec3& point, const Sample& sample) {
  const Vec3 seen = Camera::project(eye, point);
  EXPECT_GT(seen.z(), 0.01) << "nearer than the camera's clipping";
  EXPECT_LE(std::abs(seen.x()), Camera::kNarrowest) << phase_name(sample.phase) << " at " << sample.time << " s";
  EXPECT_LE(std::abs(seen.y()), 1.0) << phase_name(sample.phase) << " at " << sample.time << " s";
}

/// Rod and both grips, by their outermost points.
void expect_all_in_picture(const TestingMachine& bench, const Method& method, const Vec3& eye, const Sample& sample) {
  const double radius = method.material.radius;
  for (Eigen::Index i = 0; i < bench.state().position.cols(); ++i) {
    for (const Vec3& way : {Camera::right(), Camera::up()})
      for (const double side : {-radius, radius})
        expect_in_picture(eye, bench.state().position.col(i) + side * way, sample);
  }
  for (const GripBody& body : grip_bodies(method.specimen, method.machine, method.material)) {
    const Vec3 middle = (body.goes_up ? bench.upper_grip() : bench.lower_grip()) + body.from_grip;
    const Vec3 half = body.half_box(radius);
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0})
        for (const double z : {-1.0, 1.0}) expect_in_picture(eye, middle + half.cwiseProduct(Vec3(x, y, z)), sample);
  }
}

class ViewsOfATest : public testing::TestWithParam<Case> {};

/// From the first state to the last: tying, mounting, sliding, lock and break.
TEST_P(ViewsOfATest, MachineAndRodStayInThePicture) {
  const Method method = load_method(config(GetParam().method), GetParam().overrides);
  TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
  ProgramRunner program = make_program(method, bench.longest_step());
  ScenePicture picture(method.specimen, method.machine, method.material);
  picture.begin(bench.state().position);
  Views views(method.specimen, method.machine, method.material);
  double nearest = 0.0;
  run_test(bench, program, [&](const Command& command, const Sample& sample) {
    if (!command.read_cell && !program.ended() && sample.status == BenchStatus::kRunning) return;
    const Looks looks = views.look(bench.state().position, bench.lower_grip(), bench.upper_grip(), sample);
    expect_all_in_picture(bench, method, looks.machine.from, sample);
    const Eigen::VectorXd tension = bench.tension();
    const std::vector<ContactForce> contacts;
    const SceneView view{bench.state().position, tension, contacts,    bench.lower_grip(),
                         bench.upper_grip(),     sample,  "untangling"};
    for (const auto& marker : picture.draw_small(view, ros::Time(1.0)).markers)
      EXPECT_EQ(marker.header.frame_id, names::kBaseFrame);
    // The camera does not sway while the rod is pulled: it only ever moves away.
    const double distance = (looks.machine.at - looks.machine.from).norm();
    if (command.phase == Phase::kPull) {
      EXPECT_GE(distance, nearest - 1e-12);
      nearest = distance;
    }
  });
  EXPECT_GT(nearest, 0.0);
}

const std::vector<std::string> kThinCord = {
    "material={radius: 0.0005, density: 1150, stretching_stiffness: 2000, bending_stiffness: 3e-8, twisting_stiffness: "
    "3e-8, friction_coefficient: 0.3, breaking_force: 50}",
    "specimen.edge_length=0.0005", "specimen.length=0.15", "specimen.end_to_end=0.1",
    "program.pull.until={extension: 0.01}"};

INSTANTIATE_TEST_SUITE_P(Shipped, ViewsOfATest,
                         testing::Values(Case{"tighten.yaml", {"physics.accuracy=draft"}},
                                         Case{"tighten.yaml", {"physics.accuracy=draft", "material=pink_vps"}},
                                         Case{"overhand.yaml", {}}, Case{"capstan.yaml", {}},
                                         Case{"from_file.yaml", {}}, Case{"straight.yaml", {"specimen.length=1"}},
                                         Case{"straight.yaml", {}}, Case{"overhand.yaml", kThinCord}));

/// The camera that all of this is about, and those of the saved views.
class RvizConfig : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Shipped, RvizConfig, testing::Values("knot_utm.rviz", "bag.rviz"));

TEST_P(RvizConfig, HasTheCameraInTheFramesThatFollow) {
  const YAML::Node views = YAML::LoadFile(config(GetParam()))["Visualization Manager"]["Views"];
  std::vector<YAML::Node> cameras = {views["Current"]};
  EXPECT_EQ(views["Current"]["Target Frame"].as<std::string>(), names::kViewMachineFrame);
  std::vector<std::string> frames;
  for (const YAML::Node& saved : views["Saved"]) {
    frames.push_back(saved["Target Frame"].as<std::string>());
    if (saved["Class"].as<std::string>() == "rviz/FPS") cameras.push_back(saved);
  }
  for (const char* frame : {names::kViewKnotsFrame, names::kViewLowerKnotFrame, names::kViewUpperKnotFrame,
                            names::kMachineFrame, names::kKnotsFrame})
    EXPECT_EQ(std::count(frames.begin(), frames.end(), frame), 1) << frame;
  for (const YAML::Node& camera : cameras) {
    EXPECT_EQ(camera["Class"].as<std::string>(), "rviz/FPS");
    EXPECT_EQ(camera["Yaw"].as<double>(), Camera::kYaw);
    EXPECT_EQ(camera["Pitch"].as<double>(), Camera::kPitch);
    for (const char* axis : {"X", "Y", "Z"}) EXPECT_EQ(camera["Position"][axis].as<double>(), 0.0);
    EXPECT_LE(camera["Near Clip Distance"].as<double>(), 0.01);
  }
}

/// e says how far apart they are; they are found by the shape alone.
TEST(FindKnots, OfAFishermansKnotAreTheirDistanceApart) {
  const Method method = load_method(config("tighten.yaml"), {"physics.accuracy=draft", "program=[{tie: {}}]"});
  TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
  ProgramRunner program = make_program(method, bench.longest_step());
  Sample last;
  run_test(bench, program, [&](const Command&, const Sample& sample) { last = sample; });
  const auto found = find_knots(bench.state().position, method.material.radius, true);
  ASSERT_TRUE(found);
  EXPECT_NEAR((found->upper - found->lower).norm(), last.knot_distance, 3.0 * method.material.radius);
}

TEST(FindKnots, AStraightRodHasNone) {
  Points rod = Points::Zero(3, 101);
  rod.row(2) = Eigen::RowVectorXd::LinSpaced(101, 0.0, 1.0);
  EXPECT_FALSE(find_knots(rod, 0.003, false));
}

}  // namespace
}  // namespace knot_utm
