#include "knot_utm/grips/grips.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "knot_utm/record/sample.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

namespace {

constexpr double kSlack = 0.6;        // the rollers stand closer than taut by this until mounting [h]
constexpr double kClearance = 0.5;    // by which pins are narrower, so that the loop fits over them [h]
constexpr double kGap = 0.2;          // least gap between pins and loop [h]
constexpr double kAlongAxis = 0.999;  // cosine of the angle by which a strand leaves a clamp that turns, 2.6 degrees
constexpr double kHeld = 100.0;       // stiffness that holds the far side, or guides ends that slip [k_b/h^3]

}  // namespace

Grips::Grips(const SpecimenOptions& specimen, const MachineOptions& machine, const Centreline& centreline,
             const Material& material) {
  const double radius = material.radius;
  const double held = kHeld * material.bending_stiffness / (radius * radius * radius);
  if (rollers_hold(specimen, machine)) {
    Roller roller;
    roller.axis = Vec3::UnitY();
    roller.radius = 0.5 * machine.roller_diameter;
    roller.centre = Vec3::Zero();
    rollers_.push_back(roller);
    narrower_ = roller.radius + radius - centreline.loop.radius;
    clearance_ = kClearance * radius;
    roller.centre = Vec3(0.0, 0.0, specimen.end_to_end - kSlack * radius);
    rollers_.push_back(roller);
    if (machine.far_side == FarSide::kFree) return;
    SpringHold middle;
    middle.node = centreline.nearest_node(0.5 * (centreline.loop.far_begin + centreline.loop.far_end));
    middle.stiffness(2, 2) = held;
    const int image = centreline.half_turn ? centreline.half_turn->image(middle.node) : middle.node;
    if (image != middle.node) middle.stiffness *= 0.5;
    far_middle_ = {middle};
    middle.node = image;
    if (image != far_middle_[0].node) far_middle_.push_back(middle);
    holds_far_side_ = !specimen.to_be_tied;
    return;
  }
  const Knot& knot = knot_of(specimen);
  const bool clamped = clamps_hold(specimen, machine);
  guides_(0, 0) = guides_(1, 1) = held;
  auto hold = [&](std::vector<FixedNode>& nodes, const std::vector<HeldNode>& ends) {
    for (const HeldNode& at : ends) {
      nodes.push_back({at.node, centreline.points.col(at.node)});
      if (!clamped) continue;
      nodes.push_back({at.next, centreline.points.col(at.next)});
      held_frames_.push_back({at.edge(), 0.0});
    }
  };
  supports_ = knot.supports(specimen, material);
  for (const HungWeight& weight : centreline.weights)
    weights_.push_back({weight.node, -weight.fraction * tying_load(specimen, material) * Vec3::UnitZ()});
  if (supports_.posts.empty() || !centreline.held_lower.empty())
    hold(lower_nodes_, knot.held_lower(centreline, clamped));
  if (supports_.pins.empty()) hold(upper_nodes_, knot.held_upper(centreline, clamped));
  const auto half_edge = [&](int edge) {
    const bool there = edge >= 0 && edge + 1 < centreline.points.cols() &&
                       std::find(centreline.cuts.begin(), centreline.cuts.end(), edge) == centreline.cuts.end();
    return there ? 0.5 * (centreline.points.col(edge + 1) - centreline.points.col(edge)).norm() : 0.0;
  };
  for (const FixedNode& node : upper_nodes_) length_held_ += half_edge(node.node - 1) + half_edge(node.node);
  if (!knot_utm::clamp_turns(specimen, machine)) return;
  const std::size_t strands = upper_nodes_.size() / 2;
  for (auto frame = held_frames_.end() - static_cast<std::ptrdiff_t>(strands); frame != held_frames_.end(); ++frame) {
    const double along = (centreline.points.col(frame->edge + 1) - centreline.points.col(frame->edge)).normalized()[2];
    if (std::abs(along) > kAlongAxis) turns_by_.push_back(along > 0.0 ? 1.0 : -1.0);
  }
  if (turns_by_.size() < strands) turns_by_.clear();
  for (const FixedNode& node : upper_nodes_) turns_around_ += node.position / static_cast<double>(upper_nodes_.size());
}

bool Grips::hold(double displacement, const Vec3& point, double radius) const {
  Boundary boundary;
  set(displacement, 0.0, boundary);
  for (const Roller& roller : boundary.rollers)
    if (beside(roller, point).x.norm() < roller.radius + 2.0 * radius) return true;
  return std::any_of(boundary.fixed_nodes.begin(), boundary.fixed_nodes.end(),
                     [&](const FixedNode& node) { return (node.position - point).norm() < 2.0 * radius; });
}

void Grips::turn_clamp(double turn, Boundary& boundary) const {
  if (!clamp_turns() || turn == 0.0 || !slipping_.empty()) return;
  auto frame = boundary.fixed_twists.end() - static_cast<std::ptrdiff_t>(turns_by_.size());
  for (const double by : turns_by_) (frame++)->angle += by * turn;
  if (turns_by_.size() == 1) return;
  const Eigen::AngleAxisd turned(turn, Vec3::UnitZ());
  for (auto node = boundary.fixed_nodes.end() - static_cast<std::ptrdiff_t>(upper_nodes_.size());
       node != boundary.fixed_nodes.end(); ++node)
    node->position = turns_around_ + turned * (node->position - turns_around_);
}

double Grips::torque(const TimeStep& step) const {
  if (!clamp_turns() || step.state().twist.size() == 0) return Sample::kNone;
  double sum = 0.0;
  auto frame = held_frames_.end() - static_cast<std::ptrdiff_t>(turns_by_.size());
  for (const double by : turns_by_) sum += by * step.readings().reaction_torque((frame++)->edge);
  if (turns_by_.size() == 1) return sum;
  for (const FixedNode& node : upper_nodes_)
    sum += (step.state().position.col(node.node) - turns_around_).cross(step.readings().reaction(node.node))[2];
  return sum;
}

void Grips::set(double displacement, double left, Boundary& boundary) const {
  boundary.rollers = rollers_;
  if (on_rollers()) {
    boundary.rollers[1].centre[2] += displacement;
    if (left > 0.0) narrow(left, boundary.rollers);
  }
  boundary.rollers.insert(boundary.rollers.end(), supports_.posts.begin(), supports_.posts.end());
  for (Roller pin : supports_.pins) {
    pin.centre[2] += displacement;
    boundary.rollers.push_back(pin);
  }
  boundary.forces = supports_.loads;
  boundary.holds.clear();
  if (holds_far_side_) boundary.holds = far_middle_;
  for (SpringHold& hold : boundary.holds) hold.place[2] += half_way(displacement);
  boundary.fixed_twists = held_frames_;
  boundary.fixed_nodes = lower_nodes_;
  for (FixedNode node : upper_nodes_) {
    node.position[2] += displacement;
    if (slips(node.node))
      boundary.holds.push_back({node.node, node.position, guides_});
    else
      boundary.fixed_nodes.push_back(node);
  }
}

void Grips::hang(double part, Boundary& boundary) const {
  for (const NodeForce& weight : weights_) boundary.forces.push_back({weight.node, part * weight.force});
}

bool Grips::slips(int node) const { return std::find(slipping_.begin(), slipping_.end(), node) != slipping_.end(); }

void Grips::let_slip(int node, int next) {
  for (const FixedNode& held : upper_nodes_)
    if ((held.node == node || held.node == next) && !slips(held.node)) slipping_.push_back(held.node);
}

void Grips::follow_slipping(const Points& position, double displacement, double pulled_with) {
  pulled_with_ = pulled_with;
  for (FixedNode& held : upper_nodes_)
    if (slips(held.node)) held.position[2] = position(2, held.node) - displacement;
}

double Grips::half_way(double displacement) const { return 0.5 * (lower()[2] + upper(displacement)[2]); }

void Grips::hold_far_side(const Points& position, double displacement) {
  for (SpringHold& hold : far_middle_) hold.place[2] = position(2, hold.node) - half_way(displacement);
  holds_far_side_ = !far_middle_.empty();
}

/// Narrows rollers to pins. In a sketched loop the near side stays where it will be on the rollers, and the half
/// circles are narrower, and further out so that the length of the loop is the same.
void Grips::narrow(double left, std::vector<Roller>& rollers) const {
  if (!pins_.empty()) {
    for (std::size_t i = 0; i < pins_.size(); ++i) widen(pins_[i], left, rollers[i]);
    return;
  }
  for (Roller& roller : rollers) {
    roller.radius -= left * (narrower_ + clearance_);
    roller.centre[0] += left * narrower_;
  }
  rollers[0].centre[2] += left * (lift_ - 0.5 * M_PI * narrower_);
  rollers[1].centre[2] += left * 0.5 * M_PI * narrower_;
}

bool Grips::put_on(const Points& loop, double displacement, double radius) {
  if (!on_rollers()) return true;
  const std::vector<Roller> apart = rollers_;
  if (comes_near(loop, displacement, radius)) return true;
  rollers_ = apart;
  lift_ = 0.0;
  return put_on_pins(loop, displacement, radius);
}

/// Moves the rollers nearer to each other. Returns whether the loop then lies around both pins.
bool Grips::comes_near(const Points& loop, double displacement, double radius) {
  const double step = 0.5 * kGap * radius, most = 0.25 * end_to_end(displacement);
  Boundary pins;
  const auto touches = [&](std::size_t pin) {
    set(displacement, 1.0, pins);
    const Roller& roller = pins.rollers[pin];
    const Points away = loop.colwise() - roller.centre;
    const double nearest2 = (away.colwise().squaredNorm() - (roller.axis.transpose() * away).cwiseAbs2()).minCoeff();
    return std::sqrt(nearest2) < roller.radius + (1.0 + kGap) * radius;
  };
  while (lift_ < most && touches(0)) lift_ += step;
  rollers_[1].centre[2] -= lift_;
  for (double drop = 0.0; drop < most && touches(1); drop += step) rollers_[1].centre[2] -= step;
  return !touches(0) && !touches(1);
}

/// The upper roller comes so near that the loop is as long around the rollers as it is around the pins.
bool Grips::put_on_pins(const Points& loop, double displacement, double radius) {
  const double widest = rollers_[0].radius - narrower_ - clearance_;
  std::vector<Pin> pins = pins_in(loop, widest, (1.0 + kGap) * radius);
  if (pins.empty()) return false;
  const double apart = pins[1].place[2] - pins[0].place[2],
               wider = rollers_[0].radius + rollers_[1].radius - pins[0].radius - pins[1].radius,
               left = apart - 0.5 * M_PI * wider;
  if (left < rollers_[0].radius + rollers_[1].radius + 2.0 * radius) return false;
  rollers_[1].centre[2] = rollers_[0].centre[2] + left - displacement;
  pins_ = std::move(pins);
  return true;
}

Vec3 Grips::lower() const {
  if (on_posts()) return supports_.posts.front().centre;
  return on_rollers() ? rollers_[0].centre : lower_nodes_.front().position;
}

Vec3 Grips::upper(double displacement) const {
  const Vec3 start = on_rollers() ? rollers_[1].centre
                     : on_pins()  ? supports_.pins.front().centre
                                  : upper_nodes_.front().position;
  return start + Vec3(0.0, 0.0, displacement);
}

double Grips::end_to_end(double displacement) const {
  if (on_rollers()) return rollers_[1].centre[2] + displacement - rollers_[0].centre[2];
  if (on_posts() || on_pins()) return upper(displacement)[2] - lower()[2];
  return (upper(displacement) - lower()).norm();
}

double Grips::length_moved(double radius) const {
  if (on_rollers()) return M_PI * (rollers_[1].radius + radius);
  double length = length_held_;
  for (const Roller& pin : supports_.pins) length += M_PI * (pin.radius + radius);
  return length;
}

template <typename RollerForce, typename Reaction>
double Grips::sum_upper(double pulled_with, RollerForce roller_force, Reaction reaction) const {
  if (on_rollers()) return -roller_force(1)[2];
  double sum = pulled_with;
  for (const FixedNode& node : upper_nodes_)
    if (!slips(node.node)) sum += reaction(node.node)[2];
  const int posts = static_cast<int>(supports_.posts.size()), pins = static_cast<int>(supports_.pins.size());
  for (int i = posts; i < posts + pins; ++i) sum -= roller_force(i)[2];
  return sum;
}

double Grips::force_upper(const TimeStep& step) const {
  const StepReadings& readings = step.readings();
  return sum_upper(
      pulled_with_, [&](int i) { return readings.roller_force(i); }, [&](int i) { return readings.reaction(i); });
}

double Grips::tried_force_upper(const TimeStep& step) const {
  return sum_upper(
      slipping_.empty() ? 0.0 : pulled_with_, [&](int i) { return step.tried_roller_force(i); },
      [&](int i) { return step.tried_reaction(i); });
}

double Grips::force_lower(const TimeStep& step) const {
  if (on_rollers()) return step.readings().roller_force(0)[2];
  double sum = 0.0;
  const int posts = static_cast<int>(supports_.posts.size());
  for (int i = 0; i < posts; ++i) sum += step.readings().roller_force(i)[2];
  for (const NodeForce& load : supports_.loads) sum -= load.force[2];
  for (const NodeForce& weight : weights_) sum -= hung_ * weight.force[2];
  for (const FixedNode& node : lower_nodes_) sum -= step.readings().reaction(node.node)[2];
  return sum;
}

void Grips::state(Archive& archive) {
  archive.section("GRP6");  // "GRP5" had rollers that turn, "GRP4" had rollers that were driven, "GRP3" had no ends
                            // that slip, and no weights
  archive(lift_, holds_far_side_);
  archive.list(pins_);
  archive.require(pins_.empty() || pins_.size() == rollers_.size(), "pins of the rollers",
                  std::to_string(pins_.size()));
  for (SpringHold& hold : far_middle_) archive(hold.place);
  for (Roller& roller : rollers_) archive(roller);
  for (FixedNode& node : upper_nodes_) archive(node.position);
  archive.list(slipping_);
  archive(pulled_with_, hung_);
}

namespace {

constexpr int kPlaces = 100;               // number of heights in the loop at which a pin is tried
constexpr double kNarrowestPin = 0.05;     // of the widest
constexpr double kNearestToMiddle = 0.25;  // pins are no nearer to the middle, where the knots are [length of the loop]
constexpr double kNarrower = 0.8;          // ratio of a radius that is tried to the one before

/// The loop seen along the axes of the pins.
class Outline {
 public:
  explicit Outline(const Points& loop)
      : loop_(loop), low_(loop.rowwise().minCoeff()), high_(loop.rowwise().maxCoeff()) {}

  double height() const { return high_[2] - low_[2]; }
  double middle() const { return 0.5 * (low_[2] + high_[2]); }
  double left() const { return low_[0]; }
  double right() const { return high_[0]; }

  /// Distance of the nearest node.
  double room(double x, double z) const {
    return std::sqrt(((loop_.row(0).array() - x).square() + (loop_.row(2).array() - z).square()).minCoeff());
  }

  /// Whether the loop encloses a place: it passes above it more often to one side than to the other.
  bool goes_round(double x, double z) const {
    int turns = 0;
    for (Eigen::Index i = 0; i < loop_.cols(); ++i) {
      const Eigen::Index next = i + 1 < loop_.cols() ? i + 1 : 0;
      const double from = loop_(0, i) - x, to = loop_(0, next) - x;
      if ((from < 0.0) == (to < 0.0)) continue;
      if (loop_(2, i) + (loop_(2, next) - loop_(2, i)) * from / (from - to) > z) turns += to > from ? 1 : -1;
    }
    return turns != 0;
  }

 private:
  const Points& loop_;
  Vec3 low_, high_;
};

/// The outermost pin with this radius in the upper half (sense 1) or the lower half (-1) of the loop.
std::optional<Pin> furthest_out(const Outline& loop, double sense, double radius, double clearance) {
  const double step = loop.height() / kPlaces;
  for (double out = 0.5 * loop.height(); out > kNearestToMiddle * loop.height(); out -= step) {
    const double z = loop.middle() + sense * out;
    std::optional<Pin> best;
    double most = radius + clearance;
    for (double x = loop.left(); x <= loop.right(); x += 0.25 * step) {
      const double room = loop.room(x, z);
      if (room < most || !loop.goes_round(x, z)) continue;
      most = room;
      best = Pin{Vec3(x, 0.0, z), radius};
    }
    if (best) return best;
  }
  return std::nullopt;
}

std::optional<Pin> widest_pin(const Outline& loop, double sense, double widest, double clearance) {
  for (double radius = widest; radius > kNarrowestPin * widest; radius *= kNarrower)
    if (std::optional<Pin> pin = furthest_out(loop, sense, radius, clearance)) return pin;
  return std::nullopt;
}

}  // namespace

std::vector<Pin> pins_in(const Points& loop, double widest, double clearance) {
  const Outline outline(loop);
  const std::optional<Pin> lower = widest_pin(outline, -1.0, widest, clearance),
                           upper = widest_pin(outline, 1.0, widest, clearance);
  if (!lower || !upper) return {};
  return {*lower, *upper};
}

void widen(const Pin& pin, double left, Roller& roller) {
  roller.radius += left * (pin.radius - roller.radius);
  roller.centre += left * (pin.place - roller.centre);
}

namespace {

constexpr int kPiecesOfRing = 24;

/// The cylinders that make up a post or a ring in a picture.
std::vector<GripBody> bodies_of(const Roller& post) {
  GripBody one;
  one.cylinder_radius = post.radius;
  one.axis = post.axis;
  if (post.ring == 0.0) return {one};
  std::vector<GripBody> ring;
  const Vec3 side = post.axis.unitOrthogonal(), other = post.axis.cross(side);
  one.piece = 2.0 * post.ring * std::tan(M_PI / kPiecesOfRing);
  for (int i = 0; i < kPiecesOfRing; ++i) {
    const double angle = 2.0 * M_PI * i / kPiecesOfRing;
    const Vec3 outwards = std::cos(angle) * side + std::sin(angle) * other;
    one.from_grip = post.ring * outwards;
    one.axis = post.axis.cross(outwards);
    ring.push_back(one);
  }
  return ring;
}

}  // namespace

Vec3 GripBody::half_box(double h) const {
  if (cylinder_radius == 0.0) return Vec3(3.0, 3.0, 2.0) * h;
  const Vec3 across = (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  return cylinder_radius * across + half_length(h) * axis.cwiseAbs();
}

std::vector<GripBody> grip_bodies(const SpecimenOptions& specimen, const MachineOptions& machine,
                                  const Material& material) {
  std::vector<GripBody> bodies(2);
  bodies[1].goes_up = true;
  if (rollers_hold(specimen, machine))
    for (GripBody& roller : bodies) roller.cylinder_radius = 0.5 * machine.roller_diameter;
  const Supports supports = knot_of(specimen).supports(specimen, material);
  const KnotDrawing* drawing = specimen.drawing.get();
  const bool held_below = drawing != nullptr && !drawing->lower.empty();
  for (const std::vector<Roller>* posts : {&supports.posts, &supports.pins})
    for (const Roller& one : *posts) {
      const bool goes_up = posts == &supports.pins;
      const bool beside_grip = held_below && !goes_up;  // the lower grip is where the rope is held
      Vec3 grip = posts->front().centre;
      if (beside_grip) grip << thickest(material) * drawing->point_in_lower_grip().head<2>(), 0.0;
      bool is_grip = &one == &posts->front() && !beside_grip;
      for (GripBody& body : bodies_of(one)) {
        body.goes_up = goes_up;
        body.from_grip += one.centre - grip;
        if (std::exchange(is_grip, false))
          bodies[goes_up ? 1 : 0] = body;
        else
          bodies.push_back(body);
      }
    }
  return bodies;
}

}  // namespace knot_utm
