// A step that is warm takes nothing from the heap. An executable of its own: its malloc counts.

#include <gtest/gtest.h>

#include <cstddef>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "rod/own_laws.hpp"
#include "sim/scenes.hpp"

namespace {
std::size_t allocations = 0;
}

// All ways to the heap, those of C++ and of Eigen among them, lead through these.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void* memalign(std::size_t alignment, std::size_t size) { return aligned_alloc(alignment, size); }
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = aligned_alloc(alignment, size);
  return *memory == nullptr;
}
}

namespace knot_utm {
namespace {

/// An overhand in polypropylene with friction, one of whose ends is pulled out: strands slide, contacts come and go.
struct SlidingOverhand {
  std::unique_ptr<TimeStep> step;
  Boundary boundary;
  StepControl control{options()};
  double time = 0.0;
  double candidate_margin = 0.0;
  std::size_t taken = 0;  // from the heap, in accepted steps: what a rejected one says of its reason is text
  double way = 0.0;       // sum of the largest motions of accepted steps [m]

  static StepControl::Options options() {
    StepControl::Options out;
    out.longest = 0.05;
    out.motion = 1e-3;
    return out;
  }

  explicit SlidingOverhand(bool twist, double couple, double friction_moment = 0.0) {
    const Material material = polypropylene();
    DrawnOverhand drawn(material);
    if (friction_moment > 0.0) {
      FrictionalBending law;
      law.stick_ratio = 20.0;
      law.curvature = friction_moment / material.radius;
      set_law(drawn.rod, law);
      remember_bends(drawn.rod, &drawn.state);
    }
    if (twist) initialise_frames(&drawn.state);
    StepSettings settings = sliding_settings(material);
    settings.friction_couple = couple;
    candidate_margin = settings.candidate_margin;
    step = TimeStep::make(drawn.rod, drawn.state, settings);
    boundary = drawn.held();
  }

  void pull(double distance) {
    constexpr double kSpeed = 0.01;
    const Vec3 from = boundary.fixed_nodes[1].position;
    const double begin = time, duration = distance / kSpeed;
    std::size_t before = 0;
    const std::string gave_up = control.advance(
        *step, time, begin + duration,
        [&](double, double to) -> const Boundary& {
          boundary.fixed_nodes[1].position.z() = from.z() + kSpeed * (to - begin);
          before = allocations;
          return boundary;
        },
        [&](double, double, const StepSummary& summary) {
          taken += allocations - before;
          way += summary.largest_motion;
        });
    ASSERT_EQ(gave_up, "");
  }
};

struct Kind {
  const char* name;
  bool twist;
  double couple;
  double friction_moment = 0.0;  // of bending [k_b/h]
};

class WarmStep : public testing::TestWithParam<Kind> {};

TEST_P(WarmStep, TakesNothingFromTheHeap) {
  SlidingOverhand scene(GetParam().twist, GetParam().couple, GetParam().friction_moment);
  scene.pull(0.05);
  EXPECT_GT(scene.taken, 0U) << "the first steps have to";
  scene.taken = 0;
  scene.way = 0.0;
  const double force = scene.step->readings().reaction(0).norm();
  const int touching = scene.step->readings().contact().touching;
  scene.pull(0.05);
  EXPECT_GT(scene.way, 20.0 * scene.candidate_margin) << "candidates must have been searched again and again";
  EXPECT_NE(scene.step->readings().contact().touching, touching) << "contacts must have come or gone";
  EXPECT_GT(scene.step->readings().reaction(0).norm(), 1.5 * force) << "the knot must have slid tighter";
  EXPECT_EQ(scene.taken, 0U);
}

INSTANTIATE_TEST_SUITE_P(Twist, WarmStep,
                         testing::Values(Kind{"Off", false, 0.0}, Kind{"On", true, 0.0},
                                         Kind{"OnWithFrictionAtTheSurface", true, 1.0},
                                         Kind{"OnWithFrictionAmongFibres", true, 1.0, 0.01}),
                         [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace knot_utm
