// Steps that are not accepted change nothing, and a state that is saved goes on to the same bits elsewhere; steps that
// some run once could not make (test/failed_steps) are now made.

#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/rod/frames.hpp"
#include "sim/saved.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

/// A rod that falls onto a roller with friction, moving along it; with and without twist, under both contact laws.
struct Scene {
  bool twist;
  ContactLaw law;

  std::unique_ptr<TimeStep> stepper() const {
    Material material = braided_rope();
    material.twisting_stiffness = material.bending_stiffness;
    const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(20, material.radius));
    StepSettings settings = closed_form_settings(material);
    settings.contact_law = law;
    settings.gravity = Vec3(0.5, 0.0, -9.81);
    settings.drag = 1.0;
    settings.roller_friction = MemoryFriction{0.4, 1e-3 * material.radius};
    RodState state = straight_state(rod);
    if (twist) initialise_frames(&state);
    return TimeStep::make(rod, state, settings);
  }
  static Boundary boundary(double raised_by) {
    Boundary out;
    out.rollers = {plane_below(braided_rope().radius)};
    out.rollers[0].centre += Vec3(0.3, 0.0, 1.0) * raised_by;
    return out;
  }
};

std::string name_of(const testing::TestParamInfo<Scene>& scene) {
  return std::string(scene.param.law == ContactLaw::kEdge ? "edge" : "smooth") + (scene.param.twist ? "Twist" : "");
}
const auto kScenes = testing::Values(Scene{false, ContactLaw::kSmooth}, Scene{true, ContactLaw::kSmooth},
                                     Scene{false, ContactLaw::kEdge}, Scene{true, ContactLaw::kEdge});

class RejectedStep : public testing::TestWithParam<Scene> {};

TEST_P(RejectedStep, TheNextOneIsAsIfItHadNotBeenTried) {
  const double radius = braided_rope().radius;
  for (const int before : {0, 3}) {
    const std::unique_ptr<TimeStep> tried = GetParam().stepper(), plain = GetParam().stepper();
    for (int i = 0; i < before; ++i) {
      ASSERT_TRUE(tried->step(Scene::boundary(0.0), 0.01).accepted());
      ASSERT_TRUE(plain->step(Scene::boundary(0.0), 0.01).accepted());
    }
    // Further into the rod than a step may move it.
    EXPECT_FALSE(tried->step(Scene::boundary(10.0 * radius), 0.01).accepted());
    EXPECT_EQ(tried->readings().energies().contact, plain->readings().energies().contact);
    if (before > 0) {
      EXPECT_EQ(tried->readings().roller_force(0), plain->readings().roller_force(0));
    }
    for (int i = 1; i <= 3; ++i) {
      ASSERT_TRUE(tried->step(Scene::boundary(1e-3 * radius * i), 0.01).accepted());
      ASSERT_TRUE(plain->step(Scene::boundary(1e-3 * radius * i), 0.01).accepted());
    }
    EXPECT_EQ(tried->state().position, plain->state().position);
    EXPECT_EQ(tried->state().velocity, plain->state().velocity);
    EXPECT_EQ(tried->state().twist, plain->state().twist);
    EXPECT_EQ(tried->readings().roller_force(0), plain->readings().roller_force(0));
    EXPECT_NE(plain->readings().roller_force(0)[0], 0.0) << "friction should have had its part";
  }
}

TEST_P(RejectedStep, WhatIsNotANumberIsNeverAccepted) {
  const std::unique_ptr<TimeStep> stepper = GetParam().stepper();
  ASSERT_TRUE(stepper->step(Scene::boundary(0.0), 0.01).accepted());
  const Points position = stepper->state().position;
  for (const int node : {0, 7, 20}) {
    Boundary boundary = Scene::boundary(0.0);
    boundary.forces = {{node, Vec3(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0)}};
    const StepSummary summary = stepper->step(boundary, 0.01);
    EXPECT_FALSE(summary.accepted());
    EXPECT_EQ(summary.newton.end, NewtonSummary::End::kNotFinite);
    EXPECT_EQ(stepper->state().position, position);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, RejectedStep, kScenes, name_of);

class SavedTimeStep : public testing::TestWithParam<Scene> {};

TEST_P(SavedTimeStep, ComesToTheSameBitsElsewhere) {
  const std::unique_ptr<TimeStep> stepper = GetParam().stepper(), elsewhere = GetParam().stepper();
  Boundary boundary = Scene::boundary(0.0);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(stepper->step(boundary, 0.01).accepted());
  load(saved(*stepper), *elsewhere);
  EXPECT_EQ(saved(*elsewhere), saved(*stepper));
  boundary.rollers[0].centre += Vec3(1e-6, 0.0, 3e-6);
  const StepSummary expected = stepper->step(boundary, 0.01), found = elsewhere->step(boundary, 0.01);
  ASSERT_TRUE(expected.accepted()) << expected.reason;
  EXPECT_TRUE(found.accepted()) << found.reason;
  EXPECT_EQ(found.newton.residual, expected.newton.residual);
  EXPECT_EQ(found.newton.iterations, expected.newton.iterations);
  EXPECT_EQ(saved(*elsewhere), saved(*stepper));
}

INSTANTIATE_TEST_SUITE_P(Scenes, SavedTimeStep, kScenes, name_of);

namespace fs = std::filesystem;

std::vector<fs::path> failed_steps() {
  std::vector<fs::path> out;
  for (const fs::directory_entry& entry : fs::directory_iterator(KNOT_UTM_SOURCE_DIR "/test/failed_steps"))
    out.push_back(entry.path());
  return out;
}

std::string first_line(const std::string& bytes) { return bytes.substr(0, bytes.find('\n') + 1); }

/// A file of an earlier version whose format is still the present one, as if it were of this version.
std::string of_this_version(const std::string& bytes) {
  constexpr std::size_t kSum = 4;
  const std::string heading = first_line(Archive("time step").bytes());
  std::string out = heading + bytes.substr(first_line(bytes).size());
  out.resize(out.size() - kSum);
  const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(out.data()), out.size());
  for (std::size_t i = 0; i < kSum; ++i) out += static_cast<char>(sum >> (8 * i) & 0xff);
  return out;
}

class OnceFailedStep : public testing::TestWithParam<fs::path> {};

TEST_P(OnceFailedStep, IsMade) {
  std::ifstream in(GetParam(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  Archive archive("time step", of_this_version(bytes), GetParam().string());
  RodProperties rod;
  StepSettings settings;
  bool twist = false, curved = false;  // whether the state has frames, and natural curvatures
  double time = 0.0, dt = 0.0;
  Boundary boundary;
  archive(rod, settings, twist, curved, time, dt);
  boundary.state(archive, static_cast<int>(rod.nodes()));
  RodState state = straight_state(rod);
  if (twist) initialise_frames(&state);
  if (curved) remember_bends(rod, &state);
  const std::unique_ptr<TimeStep> stepper = TimeStep::make(rod, state, settings);
  archive(*stepper);
  archive.end();
  // As StepControl does after repeated failures.
  StepSummary summary = stepper->step(boundary, dt);
  if (!summary.newton.converged()) summary = stepper->step(boundary, dt, SolveStrategy::kSecants);
  EXPECT_TRUE(summary.accepted()) << summary.reason << "; " << summary.diagnosis.text();
}

INSTANTIATE_TEST_SUITE_P(Every, OnceFailedStep, testing::ValuesIn(failed_steps()),
                         [](const auto& file) { return file.param.stem().string(); });

}  // namespace
}  // namespace knot_utm
