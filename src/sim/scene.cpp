#include "knot_utm/sim/scene.hpp"

#include <cmath>
#include <string>

namespace knot_utm {

namespace {

constexpr int kMostIterations = 10000;

void archive_rolling(Archive& archive, RollingResistance& rolling) {
  archive(rolling.coefficient, rolling.radius, rolling.presliding, rolling.growth);
}

}  // namespace

void Boundary::state(Archive& archive, int nodes) {
  archive.section("BND3");
  archive.list(rollers);
  archive.list(fixed_nodes);
  archive.list(fixed_twists);
  archive.list(forces);
  archive.list(grips);
  archive.list(holds);
  archive(extra_drag);
  const auto require_below = [&](int count, const char* what, int number) {
    archive.require(number >= 0 && number < count, what, std::to_string(number));
  };
  for (const FixedNode& fixed : fixed_nodes) require_below(nodes, "held node", fixed.node);
  for (const FixedTwist& fixed : fixed_twists) require_below(nodes - 1, "held edge", fixed.edge);
  for (const NodeForce& force : forces) require_below(nodes, "node that is pulled", force.node);
  for (const SlippingGrip& grip : grips) require_below(nodes, "node in a grip", grip.node);
  for (const SpringHold& hold : holds) require_below(nodes, "node on a spring", hold.node);
}

void StepSettings::OtherLaws::state(Archive& archive) {
  archive(between, own, on_rollers);
  if (!archive.optional_section("PRLL", rolling_between.on() || rolling_own.on())) return;
  for (RollingResistance* rolling : {&rolling_between, &rolling_own}) archive_rolling(archive, *rolling);
  archive.require(rolling_between.on() || rolling_own.on(), "resistance of pairs to rolling", "0");
}

void StepSettings::state(Archive& archive) {
  archive.section("SET6");  // "SET5" named its pressure law, "SET4" had a bending law
  archive(pressure_law, friction, roller_friction, friction_couple, weighting_time, gravity, drag, spin_inertia,
          residual, residual_from_step, residual_of_tension, residual_at_little_tension, newton_cap, motion_limit,
          overlap_limit, candidate_margin);
  if (friction_couple > 0.0) archive_rolling(archive, rolling);
  archive.number("iterations", max_iterations, 1, kMostIterations);
  if (archive.optional_section("PAIR", others.has_value())) {
    if (archive.loads()) others.emplace();
    archive(*others);
    const auto of_one_law = [&](const PairLaws& laws, const Friction& as) {
      archive.require(std::string(laws.friction.name()) == as.name(), "friction law", laws.friction.name());
    };
    of_one_law(others->between, friction);
    of_one_law(others->own, friction);
    of_one_law(others->on_rollers, roller_friction);
  } else {
    others.reset();
  }
  const double reach = -2.0 * pressure_law.begin();
  const bool finite =
      std::isfinite(reach) && std::isfinite(candidate_margin) && reach >= 0.0 && candidate_margin >= 0.0;
  archive.require(finite, "reach of contacts", std::to_string(reach + candidate_margin) + " m");
}

}  // namespace knot_utm
