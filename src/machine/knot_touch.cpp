#include "knot_utm/machine/knot_touch.hpp"

#include <algorithm>
#include <string>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/topology/overhand_strand.hpp"

namespace knot_utm {
namespace {

NodeRange between(Eigen::Index a, Eigen::Index b) {
  return {static_cast<int>(std::min(a, b)), static_cast<int>(std::max(a, b))};
}

}  // namespace

KnotTouch::KnotTouch(const std::vector<int>& standing, double radius, int windings)
    : standing_{standing.at(0), standing.at(1)}, radius_(radius), windings_(windings) {}

void KnotTouch::follow(const TimeStep& stepper) {
  const Points& points = stepper.state().position;
  on_rollers_ = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const OverhandStrand strand = OverhandStrand::follow(points, k, standing_[k], Vec3::UnitZ(), radius_, windings_);
    if (strand.coil_found) coil_[k] = between(strand.top, strand.cut);
    if (coil_[k].empty()) continue;
    const int last = static_cast<int>(points.cols()) - 1;
    on_rollers_ +=
        stepper.readings().roller_normal_force(k == 0 ? NodeRange{0, coil_[k].last} : NodeRange{coil_[k].first, last});
  }
  between_knots_ = stepper.readings().normal_force_between(coil_[0], coil_[1]);
}

void KnotTouch::state(Archive& archive) {
  archive.section("TOUC");
  for (NodeRange& coil : coil_) archive(coil.first, coil.last);
  archive(between_knots_, on_rollers_);
}

}  // namespace knot_utm
