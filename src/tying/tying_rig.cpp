#include "knot_utm/tying/tying_rig.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/rod/isotropic_bending.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/scales.hpp"

namespace knot_utm {
namespace {

// Places of the clamps, in rod radii from the middle of the loose coil. They are clear of the tightened knot, whose
// readings would be wrong if it ran over a clamp, and the same for every loop, so that e and L do not affect tying.
constexpr double kStandingFromKnot = 8.0;  // inwards
constexpr int kGuideNodes = 3;             // neighbouring nodes that guide a strand, and so its direction
constexpr double kHalfKnot = 4.0;          // reach of a tight knot of one winding from its middle, at most [h]
constexpr double kHalfTightWinding = 1.0;  // by how much each further winding adds to that [h]

constexpr double kPuttingOnWave = 73.0;   // waves of this length relax in a tenth of the settling time meanwhile [h]
constexpr double kLongest = 2.0;          // largest factor of the length of a strand that is set to its marks [-]
constexpr double kShortest = 0.2;         // shortest edge after that, over the shortest one of the sketch [-]
constexpr double kLetGoTime = 1.0 / 3.0;  // [s]

}  // namespace

TyingRig::TyingRig(const Centreline& centreline, const RodProperties& rod, const Options& options)
    : options_(options),
      radius_(rod.material.radius),
      shortest_edge_(kShortest * rod.rest_length.minCoeff()),
      settling_(rod.material),
      rest_(options.rest) {
  const double h = rod.material.radius;
  const int nodes = static_cast<int>(rod.nodes());
  const Points& x = centreline.points;
  const std::size_t count = centreline.knots.size();
  putting_on_drag_ = settling_drag(rod.material, kPuttingOnWave * h, Settling::kTime);
  double middle = 0.0;
  for (const KnotLandmarks& knot : centreline.knots)
    middle += x(2, centreline.nearest_node(knot.coil_middle)) / static_cast<double>(count);

  for (const KnotLandmarks& marks : centreline.knots) {
    Knot knot;
    const int coil = centreline.nearest_node(marks.coil_middle);
    const double up = x(2, coil) > middle ? 1.0 : -1.0;
    knot.outwards = up * Vec3::UnitZ();
    knot.tail_node = marks.tail_end < marks.coil_middle ? 0 : nodes - 1;
    knot.reach = (kHalfKnot + kHalfTightWinding * (marks.windings - 1)) * h;

    const int inward = knot.tail_node == 0 ? 1 : -1;
    int standing = centreline.nearest_node(marks.standing_begin);
    while (up * (x(2, coil) - x(2, standing)) < kStandingFromKnot * h + marks.longer) standing += inward;
    knot.standing_node = standing;
    clamps_.push_back({standing, x.col(standing), Vec3::Zero(), false});

    // The threaded strand is the other end's; away from its own tail it runs on outwards.
    int threaded = centreline.nearest_node(marks.threaded);
    const double knot_z = x(2, threaded);
    const double beyond = kThreadedBeyondKnot * h + marks.runs_out;
    while (up * (x(2, threaded) - knot_z) < beyond) threaded -= inward;
    for (int k = 0; k < kGuideNodes; ++k, threaded -= inward)
      clamps_.push_back({threaded, x.col(threaded), Vec3::Zero(), true});
    knots_.push_back(knot);
  }
  for (int i = centreline.nearest_node(centreline.loop.far_begin);
       i <= centreline.nearest_node(centreline.loop.far_end); ++i)
    far_side_.push_back({i, x.col(i), Vec3::Zero(), false});
  loop_end_ = nodes - 1;
  tail_force_.assign(count, 0.0);
  ramp_from_.assign(count, 0.0);
}

void TyingRig::enter(Stage stage, double time) {
  stage_ = stage;
  stage_begin_ = time;
  rest_.begin();
}

void TyingRig::tie(double speed, double time, const Points& position) {
  speed_ = speed;
  grips_.begin_pull();
  rest_.forget();
  not_tied_.clear();
  attach_grips();
  grips_.begin_at(position);
  enter(Stage::kSettling, time);
}

void TyingRig::attach_grips() {
  grips_.clear();
  for (const Knot& knot : knots_) grips_.add(knot.tail_node, knot.outwards, options_.grip_stiffness, options_.preload);
}

void TyingRig::release(double duration, double time) {
  ramp_time_ = std::max(duration / 3.0, 1e-3);
  ramp_from_ = tail_force_;
  enter(Stage::kTailsRamp, time);
}

void TyingRig::let_go(const TimeStep& stepper, double time) {
  ramp_time_ = kLetGoTime;
  ramp_from_ = tail_force_;
  for (Clamp& clamp : clamps_) clamp.reaction = stepper.readings().reaction(clamp.node);
  enter(Stage::kLettingGo, time);
}

void TyingRig::put_on(const TimeStep& stepper, double time) {
  ramp_time_ = kLetGoTime;
  for (Clamp& held : far_side_) held.reaction = stepper.readings().reaction(held.node);
  for (int k = 0; k < static_cast<int>(knots_.size()); ++k) {
    const Knot& knot = knots_[static_cast<std::size_t>(k)];
    (knot.tail_node == 0 ? loop_begin_ : loop_end_) = tail_begin(k, stepper);
  }
  enter(Stage::kPuttingOn, time);
}

NodeRange TyingRig::beyond_knots() const {
  constexpr auto kClamps = static_cast<std::size_t>(1 + kGuideNodes);  // of a knot
  return {clamps_[2 * kClamps - 1].node, clamps_[kClamps - 1].node};
}

TyingRig::Laid TyingRig::longer(double apart, double beyond, const RodProperties& rod, const RodState& state) const {
  const NodeRange outside = beyond_knots();
  const Points& x = state.position;
  const double z[] = {knot_middle(0, rod, state).z(), knot_middle(1, rod, state).z()}, up = z[0] < z[1] ? 1.0 : -1.0;
  const double low = std::min(z[0], z[1]) + kStandingFromKnot * radius_,
               high = std::max(z[0], z[1]) - kStandingFromKnot * radius_;
  const int first = knots_[0].standing_node, last = knots_[1].standing_node;
  // Of an edge: 0 and 1 in either strand between the knots, 2 beyond the knots, 3 in a knot.
  const auto piece = [&](int edge) {
    if (edge < first || edge >= last) return std::size_t{3};
    if (edge >= outside.first && edge < outside.last) return std::size_t{2};
    const double middle = 0.5 * (x(2, edge) + x(2, edge + 1));
    return middle < low || middle > high ? std::size_t{3} : std::size_t{edge < outside.first ? 0U : 1U};
  };
  std::array<double, 4> length{}, shortest;
  shortest.fill(std::numeric_limits<double>::infinity());
  for (int i = first; i < last; ++i) {
    length[piece(i)] += rod.rest_length[i];
    shortest[piece(i)] = std::min(shortest[piece(i)], rod.rest_length[i]);
  }
  const auto spare = [&](std::size_t of) { return length[of] * std::max(1.0 - shortest_edge_ / shortest[of], 0.0); };
  apart = std::max(apart, -std::min(spare(0), spare(1)));
  beyond = std::max(beyond, -spare(2));
  const double of_second = high > low ? 0.5 * up * apart : 0.0;  // nothing is straight between knots that are so near
  const auto factor = [&](std::size_t of) {
    if (of == 3 || !(length[of] > 0.0)) return 1.0;
    return std::min(1.0 + (of == 2 ? beyond : apart) / length[of], kLongest);
  };
  Laid out{rod.rest_length, x};
  for (int i = 0; i < static_cast<int>(rod.edges()); ++i) out.rest_length[i] *= factor(piece(i));
  for (int i = 0; i < static_cast<int>(rod.nodes()); ++i)
    if (i < first || i > last) {
      out.position(2, i) += i > last ? of_second : -of_second;
    } else if (i > outside.first && i < outside.last) {
      // Along the rod, by less towards the middle of the far side.
      const double from_second = static_cast<double>(i - outside.first) / (outside.last - outside.first);
      out.position.col(i) += up * of_second * (1.0 - 2.0 * from_second) * (x.col(i + 1) - x.col(i - 1)).normalized();
    } else if (high > low) {
      const double share = std::clamp((x(2, i) - low) / (high - low), 0.0, 1.0);
      out.position(2, i) += up * of_second * (2.0 * share - 1.0);
    }
  return out;
}

double TyingRig::left_to_put_on(double time) const {
  return stage_ == Stage::kPuttingOn ? std::clamp(1.0 - (time - stage_begin_) / ramp_time_, 0.0, 1.0) : 0.0;
}

void TyingRig::take_guides_off(const TimeStep& stepper, double time) {
  ramp_time_ = kLetGoTime;
  for (Clamp& clamp : clamps_)
    if (clamp.guides) clamp.reaction = guide(clamp).force(stepper.state().position.col(clamp.node));
  enter(Stage::kGuidesRamp, time);
}

int TyingRig::tail_begin(int knot, const TimeStep& stepper) const {
  const Knot& k = knots_[static_cast<std::size_t>(knot)];
  const Points& x = stepper.state().position;
  const double end = knot_middle(knot, stepper.rod(), stepper.state()).dot(k.outwards) + k.reach;
  const int inward = k.tail_node == 0 ? 1 : -1;
  int node = k.tail_node;
  while (node != k.standing_node && x.col(node).dot(k.outwards) > end) node += inward;
  return node;
}

SpringHold TyingRig::guide(const Clamp& clamp) const {
  SpringHold hold;
  hold.node = clamp.node;
  hold.place = clamp.position;
  hold.stiffness = options_.grip_stiffness * (Mat3::Identity() - Vec3::UnitZ() * Vec3::UnitZ().transpose());
  return hold;
}

double TyingRig::extra_drag(double to) const {
  if (stage_ == Stage::kSettling) return settling_.drag(to - stage_begin_);
  return stage_ == Stage::kPuttingOn || stage_ == Stage::kGuided ? putting_on_drag_ : 0.0;
}

void TyingRig::hold(Boundary& boundary, double from, double to) const {
  const double ramp = std::clamp(1.0 - (to - stage_begin_) / ramp_time_, 0.0, 1.0);
  if (stage_ == Stage::kFree) return;
  if (off_rollers()) {
    for (const Clamp& held : far_side_) boundary.fixed_nodes.push_back({held.node, held.position});
  } else if (stage_ == Stage::kPuttingOn) {
    for (const Clamp& held : far_side_) boundary.forces.push_back({held.node, ramp * held.reaction});
  }
  hold_knots(boundary, ramp);
  if (stage_ == Stage::kSettling || stage_ == Stage::kPulling || stage_ == Stage::kTied) {
    grips_.add_to(boundary, stage_ == Stage::kPulling ? speed_ * (to - from) : 0.0);
  } else if (stage_ == Stage::kTailsRamp || stage_ == Stage::kLettingGo) {
    for (std::size_t k = 0; k < knots_.size(); ++k)
      boundary.forces.push_back({knots_[k].tail_node, ramp * ramp_from_[k] * knots_[k].outwards});
  }
}

void TyingRig::hold_knots(Boundary& boundary, double ramp) const {
  const bool ramps = stage_ == Stage::kClampsRamp || stage_ == Stage::kLettingGo;
  for (const Clamp& clamp : clamps_) {
    if (stage_ < Stage::kClampsRamp)
      boundary.fixed_nodes.push_back({clamp.node, clamp.position});
    else if (ramps)
      boundary.forces.push_back(
          {clamp.node, ramp * (clamp.guides ? clamp.reaction.z() * Vec3::UnitZ() : clamp.reaction)});
    if (!clamp.guides || stage_ < Stage::kClampsRamp) continue;
    if (stage_ == Stage::kGuidesRamp)
      boundary.forces.push_back({clamp.node, ramp * clamp.reaction});
    else
      boundary.holds.push_back(guide(clamp));
  }
}

void TyingRig::follow(const TimeStep& stepper, double time, double dt) {
  const Points& x = stepper.state().position;
  if (stage_ == Stage::kPulling) grips_.move(x, speed_ * dt);
  for (std::size_t k = 0; k < grips_.size(); ++k) tail_force_[k] = stage_ <= Stage::kTied ? grips_.force(k, x) : 0.0;
  const double elapsed = time - stage_begin_;
  rest_.follow(stepper.state().velocity, dt);
  switch (stage_) {
    case Stage::kSettling:
      if (Settling::over(elapsed)) {
        grips_.begin_at(x);
        enter(Stage::kPulling, time);
      }
      break;
    case Stage::kPulling:
      if (grips_.pull_is_over(x, time, rest_)) {
        enter(Stage::kTied, time);
        break;
      }
      not_tied_ = grips_.lost_patience(options_.patience, x, elapsed, speed_ * elapsed / radius_);
      break;
    case Stage::kTailsRest:
      if (rest_.waited(time, stage_begin_, "the tails were released")) {
        for (Clamp& clamp : clamps_) clamp.reaction = stepper.readings().reaction(clamp.node);
        enter(Stage::kClampsRamp, time);
      }
      break;
    case Stage::kClampsRest:
      if (elapsed >= ramp_time_ && rest_.waited(time, stage_begin_, "the clamps were released"))
        enter(Stage::kReleased, time);
      break;
    case Stage::kTailsRamp:
    case Stage::kClampsRamp:
    case Stage::kPuttingOn:
    case Stage::kGuidesRamp:
      if (elapsed >= ramp_time_) enter(static_cast<Stage>(static_cast<int>(stage_) + 1), time);
      break;
    case Stage::kLettingGo:
      if (elapsed >= ramp_time_) enter(Stage::kReleased, time);
      break;
    case Stage::kIdle:
    case Stage::kTied:
    case Stage::kReleased:
    case Stage::kGuided:
    case Stage::kFree:
      break;
  }
}

void TyingRig::state(Archive& archive) {
  archive.section("TIE4");  // "TIE3" had itself when the grips slipped
  archive.choice("stage of tying", stage_, Stage::kFree);
  archive(loop_begin_, loop_end_);
  archive(speed_, ramp_time_, stage_begin_, tail_force_, ramp_from_, rest_);
  for (Clamp& clamp : clamps_) archive(clamp.reaction);
  for (Clamp& held : far_side_) archive(held.reaction);
  bool pulls = !grips_.empty();
  archive(pulls);
  if (archive.loads() && pulls) attach_grips();
  archive(grips_);
}

std::vector<int> TyingRig::standing_nodes() const {
  std::vector<int> nodes;
  for (const Knot& knot : knots_) nodes.push_back(knot.standing_node);
  return nodes;
}

double TyingRig::excess_length(int knot, const RodState& state) const {
  const Knot& k = knots_[static_cast<std::size_t>(knot)];
  const int first = std::min(k.tail_node, k.standing_node), last = std::max(k.tail_node, k.standing_node);
  double length = 0.0;
  for (int i = first; i < last; ++i) length += (state.position.col(i + 1) - state.position.col(i)).norm();
  return length - (state.position.col(last) - state.position.col(first)).norm();
}

Vec3 TyingRig::knot_middle(int knot, const RodProperties& rod, const RodState& state) const {
  const Knot& k = knots_[static_cast<std::size_t>(knot)];
  const int first = std::min(k.tail_node, k.standing_node), last = std::max(k.tail_node, k.standing_node);
  Vec3 sum = Vec3::Zero();
  double weights = 0.0;
  for (int i = std::max(first, 1); i <= last && i + 1 < static_cast<int>(rod.nodes()); ++i) {
    const double energy = isotropic_bending_gradient(rod.material.bending_stiffness, rod.voronoi_length[i],
                                                     state.position.col(i) - state.position.col(i - 1),
                                                     state.position.col(i + 1) - state.position.col(i))
                              .energy;
    sum += energy * state.position.col(i);
    weights += energy;
  }
  return weights > 0.0 ? Vec3(sum / weights) : Vec3(state.position.col(first));
}

}  // namespace knot_utm
