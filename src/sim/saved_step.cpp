#include "knot_utm/sim/saved_step.hpp"

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

namespace {

constexpr const char* kKind = "time step";

/// What its stepper is made from.
struct Scene {
  RodProperties rod;
  StepSettings settings;
  bool twist = false, curved = false;  // whether the state has frames, and natural curvatures

  void state(Archive& archive) { archive(rod, settings, twist, curved); }

  /// With any state that fits the rod: it is to be loaded.
  std::unique_ptr<TimeStep> make_stepper() const {
    RodState straight;
    straight.position = Points::Zero(3, rod.nodes());
    straight.position.row(2) = rod.arclength().transpose();
    straight.velocity = Points::Zero(3, rod.nodes());
    if (twist) initialise_frames(&straight);
    if (curved) remember_bends(rod, &straight);
    remember_stretches(rod, &straight);
    return TimeStep::make(rod, straight, settings);
  }
};

}  // namespace

std::string save_step(TimeStep& stepper, const Boundary& boundary, double time, double dt) {
  Archive archive(kKind);
  Scene scene{stepper.made_with(), stepper.settings(), stepper.state().twist.size() > 0,
              stepper.state().curved_at_rest()};
  archive(scene, time, dt);
  Boundary own = boundary;
  own.state(archive, static_cast<int>(scene.rod.nodes()));
  archive(stepper);
  return archive.bytes();
}

SavedStep load_step(const std::string& content, const std::string& file) {
  Archive archive(kKind, content, file);
  Scene scene;
  SavedStep out;
  archive(scene, out.time, out.dt);
  archive.require(out.dt > 0.0, "length of the step", std::to_string(out.dt) + " s");
  out.boundary.state(archive, static_cast<int>(scene.rod.nodes()));
  out.stepper = scene.make_stepper();
  archive(*out.stepper);
  archive.end();
  return out;
}

}  // namespace knot_utm
