#include "knot_utm/breaking/break_watch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "knot_utm/rod/stretching.hpp"
#include "knot_utm/rod/turning_angle.hpp"
#include "knot_utm/sim/time_step.hpp"

namespace knot_utm {
namespace {

constexpr double kTouching = 1.1;   // [sum of both radii]
constexpr double kNeighbour = 5.0;  // along the rod [h]

bool turns(const RodProperties& rod, Eigen::Index node) {
  return node >= 1 && node + 1 < rod.nodes() && !rod.is_cut(node - 1) && !rod.is_cut(node);
}

/// The angle by which a rod turns at a node, along the axis of the turn [rad].
Vec3 turn(const Points& position, Eigen::Index node) {
  const Vec3 e = (position.col(node) - position.col(node - 1)).normalized();
  const Vec3 f = (position.col(node + 1) - position.col(node)).normalized();
  const Vec3 axis = e.cross(f);
  const double sine = axis.norm();
  return sine > 0.0 ? Vec3(axis * (turning_angle(e, f) / sine)) : Vec3(Vec3::Zero());
}

/// Calls add(i, w_i) for the nodes within a radius to either side of one. The quantity of a node is spread evenly over
/// its Voronoi length.
template <class Add>
void along_a_diameter(const RodProperties& rod, Eigen::Index node, const Add& add) {
  if (!turns(rod, node)) return;
  const double h = rod.material_at(node).radius;
  const auto half = [&](Eigen::Index i) { return 0.5 * rod.voronoi_length[i]; };
  add(node, std::min(1.0, h / half(node)));
  for (const int step : {-1, 1}) {
    double begin = half(node);  // distance at which the next node's length begins
    for (Eigen::Index i = node + step; begin < h && turns(rod, i); i += step) {
      const double length = rod.voronoi_length[i];
      add(i, std::min(1.0, (h - begin) / length));
      begin += length;
    }
  }
}

/// h kappa of a node.
double bend(const RodProperties& rod, const Points& position, Eigen::Index node) {
  Vec3 sum = Vec3::Zero();
  along_a_diameter(rod, node, [&](Eigen::Index i, double share) { sum += turn(position, i) * share; });
  const double h = rod.material_at(node).radius;
  return h * (sum.norm() / (2.0 * h));
}

/// h p of a node.
double pressed(const RodProperties& rod, const Pressing& pressing, Eigen::Index node) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  along_a_diameter(rod, node, [&](Eigen::Index i, double share) { sum += share * pressing.col(i); });
  return 0.25 * (sum[3] + sum.head<3>().norm());
}

/// A rod, its shape and what its contacts press with.
struct Loading {
  const RodProperties& rod;
  const Points& position;
  const Pressing& pressing;
};

/// The edges of all ropes of one material.
struct EdgesOfRopes {
  Eigen::Index begin, end;
};

/// Calls use(j, LoadedEdge) for those that are not cut.
template <class Law, class Use>
void each_edge(const Law& law, const Loading& on, const EdgesOfRopes& edges, const Use& use) {
  const bool crushes = law.crushes() && on.pressing.cols() == on.rod.nodes();
  double bend_before = 0.0, pressed_before = 0.0;
  for (Eigen::Index j = edges.begin; j < edges.end; ++j) {
    const double bend_behind = law.kBends ? bend(on.rod, on.position, j + 1) : 0.0,
                 pressed_behind = crushes ? pressed(on.rod, on.pressing, j + 1) : 0.0;
    const StretchedEdge stretched = stretched_edge(on.rod, on.position, j);
    if (!on.rod.is_cut(j))
      use(j, LoadedEdge{respond(on.rod, j, stretched).tension, stretched.stretch - 1.0,
                        std::max(bend_behind, bend_before), std::max(pressed_behind, pressed_before)});
    bend_before = bend_behind;
    pressed_before = pressed_behind;
  }
}

template <class Law>
Exposure exposure(const Law& law, const Loading& on, const EdgesOfRopes& edges) {
  Exposure out;
  each_edge(law, on, edges, [&](Eigen::Index j, const LoadedEdge& edge) {
    const double fraction = law.fraction(edge);
    if (fraction > out.fraction) out = {fraction, static_cast<int>(j), Law::kLimit, law.limited(edge)};
  });
  return out;
}

}  // namespace

RopeStrengths::RopeStrengths(const Material& material, const RodProperties& rod) {
  const Eigen::Index others = std::min(rod.first_of_other(), rod.edges());
  if (material.breaking_force) ropes_.push_back({breaking_law_of(material), 0, others});
  if (material.other && material.other->breaking_force)
    ropes_.push_back({breaking_law_of(*material.other), others, rod.edges()});
}

bool RopeStrengths::crush() const {
  return std::any_of(ropes_.begin(), ropes_.end(), [](const Ropes& ropes) {
    return std::visit([](const auto& law) { return law.crushes(); }, ropes.law);
  });
}

Exposure RopeStrengths::most_exposed(const RodProperties& rod, const Points& position, const Pressing& pressing) const {
  Exposure out;
  for (const Ropes& ropes : ropes_) {
    const Exposure found = std::visit(
        [&](const auto& law) {
          return exposure(law, Loading{rod, position, pressing}, {ropes.begin, ropes.end});
        },
        ropes.law);
    if (found.fraction > out.fraction || out.edge < 0) out = found;
  }
  return out;
}

bool lies_in_knot(const RodProperties& rod, const Points& position, int edge) {
  const Eigen::VectorXd arclength = rod.arclength();
  const auto middle = [&](Eigen::Index j) -> Vec3 { return 0.5 * (position.col(j) + position.col(j + 1)); };
  const double h = rod.material_at(edge).radius;
  for (Eigen::Index j = 0; j < rod.edges(); ++j) {
    if (rod.is_cut(j) || std::abs(arclength[j] - arclength[edge]) <= kNeighbour * h) continue;
    const double reach = kTouching * (h + rod.material_at(j).radius) + 0.5 * rod.rest_length[j];
    if ((middle(j) - middle(edge)).squaredNorm() < reach * reach) return true;
  }
  return false;
}

namespace {

constexpr double kOvershoot = 1.001;  // fraction of the strength that a step may reach, unless it is the shortest one
constexpr double kAbsurd = 2.0;       // fraction that no step may reach
constexpr double kPressed = 0.01;     // share of the parting tension up to which a push on the grips does not count

const char* name_of(BreakLimit limit) { return limit == BreakLimit::kForce ? "tension" : "strain"; }

/// Ropes are numbered from 1, in the order of the knot's file.
std::string which_rope(const std::vector<int>& cuts, int edge) {
  if (cuts.empty()) return "";
  const auto before = std::count_if(cuts.begin(), cuts.end(), [&](int cut) { return cut < edge; });
  return ", in rope " + std::to_string(before + 1);
}

}  // namespace

std::string BreakWatch::refuse(const Exposure& to, double dt) const {
  // A rod that begins beyond its strength, as a shape that was sketched with too sharp a bend, parts at once.
  if (before_ >= 1.0 || to.fraction <= (dt > shortest_ ? kOvershoot : kAbsurd)) return {};
  std::ostringstream text;
  text << "the " << name_of(to.limit) << " would jump from " << before_ << " to " << to.fraction
       << " times what the rod bears in one step";
  return text.str();
}

bool BreakWatch::judge(const Exposure& now, double dt) {
  next_ = std::numeric_limits<double>::infinity();
  const bool parted = now.fraction >= 1.0;
  if (!parted && now.fraction > before_)
    next_ = std::max((1.0 - now.fraction) / (now.fraction - before_) * dt, shortest_);
  before_ = now.fraction;
  return parted;
}

std::string not_by_tension(const Exposure& parted, double upper, double lower) {
  const double force = std::max(upper, lower);
  if (parted.limit != BreakLimit::kForce || force >= -kPressed * parted.value) return {};
  std::ostringstream text;
  text << "the rod would part at a tension of " << parted.value << " N while its grips are pressed together by "
       << -force << " N: the time step is wrong, and the rod did not part";
  return text.str();
}

RodBreak::RodBreak(const Material& material, const TimeStep& stepper, double shortest)
    : strengths_(material, stepper.rod()), watch_(shortest, exposure(stepper, stepper.state().position)) {}

Exposure RodBreak::exposure(const TimeStep& stepper, const Points& position) const {
  // The readings of pressing are those of the step that is judged.
  return strengths_.most_exposed(stepper.rod(), position,
                                 strengths_.crush() ? stepper.readings().pressing() : Pressing());
}

std::string RodBreak::refuse(const TimeStep& stepper, const Points& end, double dt) const {
  return watch_.refuse(exposure(stepper, end), dt);
}

std::optional<Exposure> RodBreak::judge(const TimeStep& stepper, double dt) {
  const Exposure now = exposure(stepper, stepper.state().position);
  if (watch_.judge(now, dt)) return now;
  return std::nullopt;
}

std::string RodBreak::describe(const TimeStep& stepper, const Exposure& reached, BreakPlace place) const {
  std::ostringstream text;
  text << "the rod parted " << break_arclength(stepper, reached.edge) << " m along its length"
       << which_rope(stepper.rod().cuts, reached.edge) << " (" << break_place_name(place)
       << (reached.limit == BreakLimit::kForce ? ") at a tension of "
           : strengths_.crush()                ? ") where stretch, bend and crushing came to a strain of "
                                               : ") at a strain of its outermost fibre of ")
       << reached.value << (reached.limit == BreakLimit::kForce ? " N" : "");
  return text.str();
}

double break_arclength(const TimeStep& stepper, int edge) { return stepper.rod().place(edge, 0.5); }

}  // namespace knot_utm
