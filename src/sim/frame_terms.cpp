#include "knot_utm/sim/frame_terms.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "knot_utm/rod/frames.hpp"

namespace knot_utm {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Vec3 column(const Points& points, int j) { return points.col(j); }

// Well above the rounding of the factorisation, far below anything that twists: over a thousand edges, a millionth of
// the stiffness of one.
constexpr double kRest = 1e-9;        // r_j [k_t/l_j]
constexpr double kLongestTurn = 0.5;  // of an edge in one iteration [rad]

void subtract(const StencilVector& gradient, int i, std::vector<Lanes>& force) {
  for (int k = 0; k < 3; ++k) {
    const double* g = gradient.data() + 4 * k;
    force[at(i - 1 + k)] -= Lanes{g[0], g[1], g[2], k < 2 ? g[3] : 0.0};
  }
}

}  // namespace

FrameTerms::FrameTerms(const RodProperties& rod, const StepSettings& settings)
    : rod_(rod),
      curved_(rod.natural_curvature.cols() > 0),
      held_(static_cast<std::size_t>(rod.nodes()), 0),
      start_tangent_(3, rod.edges()),
      edge_(3, rod.edges()),
      tangent_(3, rod.edges()),
      length_(rod.edges()),
      director_(3, rod.edges()),
      angle_(rod.edges()),
      reference_twist_(rod.nodes() - 2),
      torque_(rod.edges()) {
  const double h2 = rod.material.radius * rod.material.radius;
  const double counts = settings.spin_inertia ? 1.0 : 0.0;
  inertia_ = (counts * 0.5 * rod.material.density * M_PI * h2 * h2) * rod.rest_length;
  drag_ = (counts * settings.drag * h2) * rod.rest_length;
  rest_ = ((1.0 - counts) * kRest * rod.material.twisting_stiffness) * rod.rest_length.cwiseInverse();
}

void FrameTerms::begin_step(const RodState& start, const std::vector<FixedTwist>& held, double dt) {
  start_ = &start;
  dt_ = dt;
  const int edges = static_cast<int>(rod_.edges());
  for (int j = 0; j < edges; ++j)
    start_tangent_.col(j) = (start.position.col(j + 1) - start.position.col(j)).normalized();
  angle_ = start.twist + dt * start.twist_rate;
  std::fill(held_.begin(), held_.end(), 0);
  held_.back() = 1;
  for (const FixedTwist& fixed : held) {
    held_[at(fixed.edge)] = 1;
    angle_[fixed.edge] = fixed.angle;
  }
}

void FrameTerms::add_forces(const Points& position, std::vector<Lanes>& force) {
  const int edges = static_cast<int>(rod_.edges());
  for (int j = 0; j < edges; ++j) {
    edge_.col(j) = position.col(j + 1) - position.col(j);
    length_[j] = edge_.col(j).norm();
    tangent_.col(j) = edge_.col(j) / length_[j];
    director_.col(j) =
        transported_director(column(start_->reference_director, j), column(start_tangent_, j), column(tangent_, j));
  }
  torque_.setZero();
  for (int i = 1; i < edges; ++i) {
    const int e = i - 1, f = i;
    reference_twist_[e] = nearest_turn(
        reference_twist(column(director_, e), column(tangent_, e), column(director_, f), column(tangent_, f)),
        start_->reference_twist[e]);
    StencilVector gradient = node_twisting(i).gradient;
    if (curved_) gradient += node_bending(i).gradient;
    torque_[e] += gradient[3];
    torque_[f] += gradient[7];
    subtract(gradient, i, force);
  }
  for (int j = 0; j < edges; ++j) {
    const double turned = angle_[j] - start_->twist[j], rate = turned / dt_;
    force[at(j)][3] -= inertia_[j] * (rate - start_->twist_rate[j]) / dt_ + drag_[j] * rate + rest_[j] * turned;
  }
}

TwistingInput FrameTerms::twisting_input(int i) const {
  const double whole = i == parted_ || i == parted_ + 1 ? 0.0 : 1.0;
  return {whole * rod_.material.twisting_stiffness, rod_.voronoi_length[i],
          rod_.natural_twist.size() > 0 ? rod_.natural_twist[i - 1] : 0.0};
}

BendingInput FrameTerms::bending_input(int i) const {
  const double whole = i == parted_ || i == parted_ + 1 ? 0.0 : 1.0;
  return {whole * rod_.material.bending_stiffness, rod_.voronoi_length[i], rod_.natural_curvature.col(i - 1)};
}

StencilGradient FrameTerms::node_twisting(int i) const {
  const double twist = angle_[i] - angle_[i - 1] + reference_twist_[i - 1];
  return twisting_gradient(twisting_input(i), column(edge_, i - 1), column(edge_, i), twist);
}

StencilGradient FrameTerms::node_bending(int i) const {
  const int e = i - 1, f = i;
  return bending_gradient(bending_input(i), column(edge_, e), column(edge_, f),
                          material_directors(column(tangent_, e), column(director_, e), angle_[e]),
                          material_directors(column(tangent_, f), column(director_, f), angle_[f]));
}

FrameTerms::NodeStiffness FrameTerms::node_stiffness(int i) const {
  const int e = i - 1, f = i;
  const double twist = angle_[f] - angle_[e] + reference_twist_[e];
  NodeStiffness out = NodeStiffness::Zero();
  out.topLeftCorner<kStencilSize, kStencilSize>() =
      twisting(twisting_input(i), column(edge_, e), column(edge_, f), twist).hessian;
  if (curved_)
    out.topLeftCorner<kStencilSize, kStencilSize>() +=
        bending(bending_input(i), column(edge_, e), column(edge_, f),
                material_directors(column(tangent_, e), column(director_, e), angle_[e]),
                material_directors(column(tangent_, f), column(director_, f), angle_[f]))
            .hessian;
  return out;
}

Vec3 FrameTerms::lean(int j) const {
  const Vec3 before = start_tangent_.col(j), now = tangent_.col(j);
  return now.cross(before) / ((1.0 + before.dot(now)) * length_[j]);
}

FrameTerms::EdgeStiffness FrameTerms::edge_stiffness(int j) const {
  EdgeStiffness out;
  const Vec3 w = (0.5 * torque_[j] / (length_[j] * length_[j])) * column(tangent_, j);
  out.sweep << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  out.spin = inertia_[j] / (dt_ * dt_) + drag_[j] / dt_ + rest_[j];
  out.lean = lean(j);
  return out;
}

double FrameTerms::angle_change(const std::vector<Lanes>& change, int j) const {
  return held(j) ? 0.0 : change[at(j)][3] - lean(j).dot(to_vec3(change[at(j + 1)] - change[at(j)]));
}

double FrameTerms::longest_share(const std::vector<Lanes>& change) const {
  double longest = 0.0;
  for (int j = 0; j < static_cast<int>(rod_.edges()); ++j)
    longest = std::max(longest, std::abs(angle_change(change, j)));
  return longest > kLongestTurn ? kLongestTurn / longest : 1.0;
}

void FrameTerms::move(const std::vector<Lanes>& change, double share) {
  for (int j = 0; j < static_cast<int>(rod_.edges()); ++j) angle_[j] += share * angle_change(change, j);
}

void FrameTerms::commit(RodState& state) const {
  state.twist_rate = (angle_ - start_->twist) / dt_;
  state.twist = angle_;
  state.reference_director = director_;
  state.reference_twist = reference_twist_;
}

FrameTerms::Energy FrameTerms::energy(const Points& way, const std::vector<Lanes>& force) const {
  Energy out;
  const int edges = static_cast<int>(rod_.edges());
  const auto turn = [&](int j) { return angle_[j] - start_->twist[j]; };
  for (int i = 1; i < edges; ++i) {
    const int e = i - 1, f = i;
    const StencilGradient twist = node_twisting(i);
    out.twisting += twist.energy;
    StencilVector gradient = twist.gradient;
    if (curved_) {
      const StencilGradient bend = node_bending(i);
      out.bending += bend.energy;
      gradient += bend.gradient;
    }
    StencilVector moved;
    moved << way.col(e), turn(e), way.col(i), turn(f), way.col(i + 1);
    out.along += gradient.dot(moved);
  }
  for (int j = 0; j < edges; ++j) {
    const double turned = turn(j), rate = turned / dt_, change = rate - start_->twist_rate[j];
    if (!held(j)) out.residual += force[at(j)][3] * turned;
    out.drag += drag_[j] * rate * turned;
    out.rest += rest_[j] * turned * turned;
    out.inertia += 0.5 * inertia_[j] * change * change;
    out.kinetic += 0.5 * inertia_[j] * rate * rate;
  }
  return out;
}

}  // namespace knot_utm
