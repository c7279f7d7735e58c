#include "knot_utm/verdict/speed_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "knot_utm/numeric/number.hpp"
#include "knot_utm/record/preparing_steps.hpp"
#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {
namespace {

constexpr double kFast = 0.01;           // share of F that is told
constexpr double kHardlyAny = 1e-6;      // accelerated mass, by choice: a smaller one helps no more [own mass]
constexpr double kTiedByDefault = 3.15;  // `program.tie.speed: auto` of src/method/method.cpp [radii/s]
/// Here the plateaus of nylon and polypropylene are 1.1 and 0.3 % lower: config/tighten.yaml with
/// program.tie.speed=0.029 [radii/s].
constexpr double kTiedSlow = 3.0 * kTiedByDefault;
/// Ten times the default moved the plateau of nylon by -8 %, of polypropylene by -7 %
/// (config/tighten.yaml with program.tie.speed=0.1).
constexpr const char* kTiedFast =
    "; ten times the default changes a sliding force by up to 8 %, so choose a lower program.tie.speed";

constexpr double kPulledAsShipped = 1.04;  // [radii/s]
/// At three times that the plateaus of nylon and polypropylene are the same to 0.4 % (scripts/bench sizes, five
/// starts).
constexpr double kPulledSlow = 5.0 * kPulledAsShipped;
/// Ten times moved the plateau of nylon by 2.9 %, of polypropylene by 1.2 %.
constexpr const char* kPulledFast =
    "; ten times that changes a sliding force by up to 3 %, so choose a lower program.pull.speed";

/// A node that is so many times as fast as the pull snaps. While shipped knots slide, nodes are 11 to 42 times as fast
/// as the pull; where a strand or a frame lets go, 200 to 500 times.
constexpr double kSnaps = 100.0;

std::string in_per_cent(double share) { return format_number(std::round(1000.0 * share) / 10.0) + " %"; }

std::string two_digits(double value) {
  std::ostringstream out;
  out.precision(2);
  out << value;
  return out.str();
}

std::string about(double share) { return share > 1.0 ? "more than itself" : "about " + in_per_cent(share); }

}  // namespace

std::vector<std::string> speed_warnings(const RateShares& rate, double inertia) {
  std::vector<std::string> all;
  const double by_drag = rate.drag.value_or(0.0), by_inertia = rate.inertia.value_or(0.0);
  const double by_own = by_inertia / std::min(1.0, inertia);
  if (by_drag > 1.0)
    all.push_back("drag takes " + two_digits(by_drag) +
                  " times the work of the pull: the specimen moves by something else than the pull");
  else if (by_drag > kFast)
    all.push_back("drag makes up " + in_per_cent(by_drag) +
                  " of the force until the knots lock: choose a smaller physics.drag or pull more slowly");
  if (by_inertia > kFast)
    all.push_back("inertia changes the force by " + in_per_cent(by_inertia) + " until the knots lock: " +
                  (inertia > kHardlyAny ? "choose a physics.inertia much smaller than " + two_digits(inertia)
                                        : std::string("pull more slowly")));
  else if (by_own > kFast)
    all.push_back("the simulation accelerates only " + two_digits(inertia) +
                  " of the rod's own mass (physics.inertia); all of it would change the force by " + about(by_own) +
                  " until the knots lock, so a real test would have to be pulled more slowly");
  return all;
}

std::vector<std::string> snap_warnings(const Results& results, double pull_speed) {
  if (results.curve.jump_force || results.snap_extension || !(pull_speed > 0.0) ||
      !(results.fastest_node > kSnaps * pull_speed))
    return {};
  return {"something let go at once before the knots locked: a node moved at " + short_number(results.fastest_node) +
          " m/s, " + short_number(results.fastest_node / pull_speed) +
          " times as fast as the pull; how far the load falls then depends on inertia and on the frame"};
}

std::vector<std::string> speed_warnings(const Method& method) {
  std::vector<std::string> all;
  for (const ProgramStep& step : method.program) {
    const double speed = step->speed / method.material.radius;
    const std::string told = format_number(std::round(10.0 * speed) / 10.0);
    if (step.as<TieStep>() && speed > kTiedSlow)
      all.push_back("the knots are tied at " + told + " radii a second, by default at " +
                    format_number(kTiedByDefault) + kTiedFast);
    if (pulls(step->phase()) && speed > kPulledSlow && knot_of(method.specimen).about().loop)
      all.push_back("the loop is pulled at " + told + " radii a second, as shipped at " +
                    format_number(kPulledAsShipped) + kPulledFast);
  }
  return all;
}

}  // namespace knot_utm
