#include "knot_utm/sim/frame_terms.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "axes.hpp"
#include "knot_utm/numeric/index.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

namespace {

// Well above the rounding of the factorisation, far below anything that twists: over a thousand edges, a millionth of
// the stiffness of one.
constexpr double kRest = 1e-9;        // r_j [k_t/l_j]
constexpr double kLongestTurn = 0.5;  // of an edge in one iteration [rad]

FourVectors four(const std::vector<Lanes>& vectors, std::size_t first) {
  return FourVectors::of(vectors[first], vectors[first + 1], vectors[first + 2], vectors[first + 3]);
}
Lanes four(const std::vector<double>& numbers, std::size_t first) {
  return Lanes{numbers[first], numbers[first + 1], numbers[first + 2], numbers[first + 3]};
}

/// Four vectors, or four numbers, to where they belong.
void put(const FourVectors& vectors, std::vector<Lanes>& to, std::size_t first) {
  Lanes a = vectors.x, b = vectors.y, c = vectors.z, d = {};
  transpose(a, b, c, d);
  to[first] = a;
  to[first + 1] = b;
  to[first + 2] = c;
  to[first + 3] = d;
}
void put(const Lanes& numbers, std::vector<double>& to, std::size_t first) {
  for (int k = 0; k < 4; ++k) to[first + static_cast<std::size_t>(k)] = numbers[k];
}

/// Four rotations as quaternions of any length.
struct Turns {
  Lanes w;
  FourVectors v;
};
/// Parallel transport from one tangent to another.
Turns transport(const FourVectors& from, const FourVectors& to) { return {1.0 + dot(from, to), cross(from, to)}; }
/// First the right one.
Turns operator*(const Turns& l, const Turns& r) {
  return {l.w * r.w - dot(l.v, r.v), l.w * r.v + r.w * l.v + cross(l.v, r.v)};
}

/// The angle of a turn about a unit vector, the smaller way round [rad]: 2 atan(tangent of its half), by its series
/// where that is less than a tenth, where the first term left out is 1e-17 of it.
Lanes angle_about(const FourVectors& axis, const Turns& turn) {
  const Lanes sine = dot(turn.v, axis), size = larger(sine, -sine);
  const auto small = size < 0.1 * turn.w;
  const Lanes x = sine / select(small, turn.w, constant<Lanes>(1.0)), y = x * x;
  Lanes series = constant<Lanes>(1.0 / 15.0);
  for (const double term : {13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0}) series = 1.0 / term - y * series;
  Lanes out = 2.0 * x * series;
  for (int k = 0; k < 4; ++k)
    if (!(size[k] < 0.1 * turn.w[k])) out[k] = std::remainder(2.0 * std::atan2(sine[k], turn.w[k]), 2.0 * M_PI);
  return out;
}

/// w x
struct Cross {
  explicit Cross(const Lanes& w)
      : column{Lanes{0.0, w[2], -w[1], 0.0}, Lanes{-w[2], 0.0, w[0], 0.0}, Lanes{w[1], -w[0], 0.0, 0.0}} {}
  Lanes column[3];
};

}  // namespace

FrameTerms::FrameTerms(const RodProperties& rod, const StepSettings& settings)
    : rod_(rod),
      bending_(rod),
      rolls_(settings.friction_couple > 0.0),
      held_(static_cast<std::size_t>(rod.nodes()), 0),
      start_tangent_(held_.size() + 3, Lanes{1.0, 0.0, 0.0, 0.0}),
      edge_(start_tangent_),
      tangent_(start_tangent_),
      inverse_length_(start_tangent_.size(), 1.0),
      lean_(start_tangent_.size()),
      turns_{std::vector<double>(start_tangent_.size()), std::vector<double>(start_tangent_.size()),
             std::vector<Lanes>(start_tangent_.size()), std::vector<Lanes>(start_tangent_.size())},
      stiffness_(start_tangent_.size(), 0.0),
      binormal_(start_tangent_.size()),
      over_chi_(start_tangent_.size(), 0.0),
      twist_(start_tangent_.size(), 0.0),
      moment_(start_tangent_.size(), 0.0),
      tangent_stiffness_(start_tangent_.size(), 0.0),
      director_(3, rod.edges()),
      angle_(start_tangent_.size(), 0.0),
      start_twist_(start_tangent_.size(), 0.0),
      reference_twist_(start_tangent_.size(), 0.0),
      torque_(start_tangent_.size(), 0.0) {
  const double h2 = rod.material.radius * rod.material.radius;
  const double counts = settings.spin_inertia ? 1.0 : 0.0;
  inertia_ = (counts * 0.5 * rod.material.density * M_PI * h2 * h2) * rod.rest_length;
  drag_ = (counts * settings.drag * h2) * rod.rest_length;
  rest_ = ((1.0 - counts) * kRest * rod.material.twisting_stiffness) * rod.rest_length.cwiseInverse();
  for (int i = 1; i + 1 < static_cast<int>(rod.nodes()); ++i)
    stiffness_[at(i)] = rod.material.twisting_stiffness / rod.voronoi_length[i];
}

void FrameTerms::part(int edge) {
  parted_ = edge;
  bending_.part(edge);
  stiffness_[at(edge)] = stiffness_[at(edge + 1)] = 0.0;
}

void FrameTerms::begin(const StepStart& step) {
  const RodState& start = step.state;
  start_ = &start;
  curved_ = start.curved_at_rest();
  bending_.begin();
  dt_ = step.dt;
  const int edges = static_cast<int>(rod_.edges());
  for (int j = 0; j < edges; ++j) {
    start_tangent_[at(j)] = to_lanes(Vec3((start.position.col(j + 1) - start.position.col(j)).normalized()));
    angle_[at(j)] = start.twist[j] + dt_ * start.twist_rate[j];
  }
  for (int i = 1; i < edges; ++i) {
    reference_twist_[at(i)] = start.reference_twist[i - 1];
    start_twist_[at(i)] =
        start.reference_twist[i - 1] - (rod_.natural_twist.size() > 0 ? rod_.natural_twist[i - 1] : 0.0);
  }
  std::fill(held_.begin(), held_.end(), 0);
  held_.back() = 1;
  for (const FixedTwist& fixed : step.boundary.fixed_twists) {
    held_[at(fixed.edge)] = 1;
    angle_[at(fixed.edge)] = fixed.angle;
  }
}

void FrameTerms::set_tangents(const Points& position) {
  const std::size_t edges = static_cast<std::size_t>(rod_.edges());
  for (std::size_t j = 0; j < edges; ++j) {
    const double* x = position.data() + 3 * j;
    edge_[j] = Lanes{x[3] - x[0], x[4] - x[1], x[5] - x[2], 0.0};
    inverse_length_[j] = 1.0 / std::sqrt(dot(edge_[j], edge_[j]));
    tangent_[j] = inverse_length_[j] * edge_[j];
  }
  for (std::size_t j = 0; j < edges; j += 4) {
    const FourVectors before = four(start_tangent_, j), now = four(tangent_, j);
    put(four(inverse_length_, j) / (1.0 + dot(before, now)) * cross(now, before), lean_, j);
  }
}

/// m_ref, b, chi and the moment of every inner node.
void FrameTerms::set_twist() {
  const std::size_t edges = static_cast<std::size_t>(rod_.edges());
  for (std::size_t i = 1; i < edges; i += 4) {
    const FourVectors e = four(tangent_, i - 1), f = four(tangent_, i);
    const FourVectors e_n = four(start_tangent_, i - 1), f_n = four(start_tangent_, i);
    const Turns e_to_f = transport(e, f);
    // Back from f to e as the conjugate; behind the last node there are no edges, and nothing is read.
    const Turns around = transport(e_n, f_n) * transport(e, e_n) * Turns{e_to_f.w, -1.0 * e_to_f.v} * transport(f_n, f);
    const Lanes turned = angle_about(f_n, around), over_chi = 1.0 / e_to_f.w;
    const Lanes twist = four(angle_, i) - four(angle_, i - 1) + four(start_twist_, i) + turned;
    const Lanes stiffness = four(stiffness_, i);
    put(2.0 * over_chi * e_to_f.v, binormal_, i);
    put(over_chi, over_chi_, i);
    put(twist, twist_, i);
    put(stiffness * twist, moment_, i);
    put(stiffness, tangent_stiffness_, i);
    put(turned, reference_twist_, i);
  }
  for (std::size_t i = 1; i < edges; ++i)
    reference_twist_[i] += start_->reference_twist[static_cast<Eigen::Index>(i) - 1];
}

void FrameTerms::carry_directors() {
  for (int j = 0; j < static_cast<int>(rod_.edges()); ++j)
    director_.col(j) = transported_director(start_->reference_director.col(j), to_vec3(start_tangent_[at(j)]),
                                            to_vec3(tangent_[at(j)]));
}

void FrameTerms::add_forces(const StepStart&, const Points& x, std::vector<Lanes>& force) {
  const int edges = static_cast<int>(rod_.edges());
  set_tangents(x);
  set_twist();
  std::fill(torque_.begin(), torque_.end(), 0.0);
  for (std::size_t i = 1; i < static_cast<std::size_t>(edges); ++i) {
    const double half = 0.5 * moment_[i];
    const Lanes on_e = (half * inverse_length_[i - 1]) * binormal_[i],
                on_f = (half * inverse_length_[i]) * binormal_[i];
    const Lanes torque = moment_[i] * kSpin;
    force[i - 1] += on_e + torque;
    force[i] -= on_e - on_f + torque;
    force[i + 1] -= on_f;
    torque_[i - 1] -= moment_[i];
    torque_[i] += moment_[i];
  }
  if (curved_) {
    carry_directors();
    bending_.evaluate(*start_, dt_, tangent_, inverse_length_, director_, angle_);
    bending_.add_forces(force, torque_);
  }
  for (int j = 0; j < edges; ++j) {
    const double turned = angle_[at(j)] - start_->twist[j], rate = turned / dt_;
    if (rolls_) set_turn(at(j), turned);
    force[at(j)][3] -= inertia_[j] * (rate - start_->twist_rate[j]) / dt_ + drag_[j] * rate + rest_[j] * turned;
  }
}

void FrameTerms::set_turn(std::size_t j, double turned) {
  turns_.turn[j] = turned;
  turns_.length[j] = 1.0 / inverse_length_[j];
  turns_.tangent[j] = tangent_[j];
  turns_.pull[j] = lean_[j] - (turned * inverse_length_[j]) * tangent_[j];
}

TwistingInput FrameTerms::twisting_input(int i) const {
  const double whole = i == parted_ || i == parted_ + 1 ? 0.0 : 1.0;
  return {whole * rod_.material.twisting_stiffness, rod_.voronoi_length[i],
          rod_.natural_twist.size() > 0 ? rod_.natural_twist[i - 1] : 0.0};
}

double FrameTerms::twist(int i) const { return angle_[at(i)] - angle_[at(i - 1)] + reference_twist_[at(i)]; }

FrameTerms::NodeStiffness FrameTerms::node_stiffness(int i) const {
  NodeStiffness out = NodeStiffness::Zero();
  auto elastic = out.topLeftCorner<kStencilSize, kStencilSize>();
  elastic = twisting(twisting_input(i), to_vec3(edge_[at(i - 1)]), to_vec3(edge_[at(i)]), twist(i)).hessian;
  if (curved_) elastic += bending_.hessian(i);
  return out;
}

FrameTerms::EdgeStiffness FrameTerms::edge_stiffness(int j) const {
  EdgeStiffness out;
  const Lanes w = (0.5 * torque_[at(j)] * inverse_length_[at(j)] * inverse_length_[at(j)]) * tangent_[at(j)];
  out.sweep << 0.0, -w[2], w[1], w[2], 0.0, -w[0], -w[1], w[0], 0.0;
  out.spin = inertia_[j] / (dt_ * dt_) + drag_[j] / dt_ + rest_[j];
  out.lean = lean(j);
  return out;
}

/// With t = mean and s_e = u + t, the Hessian of twisting.hpp by its right factors b and s.
FrameTerms::TwistStiffness FrameTerms::twist_stiffness(std::size_t node) const {
  const double k = tangent_stiffness_[node], moment = moment_[node], over_chi = over_chi_[node];
  const double over_e = inverse_length_[node - 1], over_f = inverse_length_[node];
  const Lanes &b = binormal_[node], &u = tangent_[node - 1], &v = tangent_[node];
  const Lanes mean = over_chi * (u + v), s_e = u + mean, s_f = v + mean;
  const double turn_e = 0.25 * moment * over_e * over_e, turn_f = 0.25 * moment * over_f * over_f;
  const double turn_ef = 0.5 * moment * over_e * over_f, twice = 2.0 * over_chi * turn_ef;
  TwistStiffness out;
  out.stiffness = k;
  out.by_e = (0.5 * k * over_e) * b;
  out.by_f = (0.5 * k * over_f) * b;
  const Lanes ee_b = (0.5 * over_e) * out.by_e - turn_e * s_e, ff_b = (0.5 * over_f) * out.by_f - turn_f * s_f;
  const Lanes on_s_e = turn_e * b, on_s_f = turn_f * b, both = (0.5 * over_f) * out.by_e, ef_mean = turn_ef * b;
  const Lanes fe_b = both - turn_ef * mean;
  const Cross across(twice * u);
  for (int c = 0; c < 3; ++c) {
    out.ee[c] = ee_b * b[c] - on_s_e * s_e[c];
    out.ff[c] = ff_b * b[c] - on_s_f * s_f[c];
    out.ef[c] = both * b[c] - ef_mean * mean[c] + across.column[c];
    out.fe[c] = fe_b * b[c] - across.column[c];
  }
  return out;
}

void FrameTerms::add_stiffness(LinearSystem<4>& system) const {
  StepMatrix<4>& matrix = system.matrix;
  const std::size_t nodes = held_.size(), edges = nodes - 1;
  // As CentrelineTerms::add_stiffness: by A_j of every edge, here with its sweep, and B_i of the two edges of a node.
  // With g = d2E/dm2 (-m_e, m_e - m_f, m_f) of nodes i-1 to i+1, the spins before and behind node i add -g and g.
  TwistStiffness here{}, after{};
  Lanes edge_before[3] = {}, edge[3] = {};
  for (std::size_t i = 0; i < nodes; ++i, here = after) {
    const auto& stencil = matrix.stencil(static_cast<int>(i));
    const bool last = i == edges;
    after = i + 1 < edges ? twist_stiffness(i + 1) : TwistStiffness{};
    const Lanes middle = here.by_e - here.by_f;
    Block<4>& own = matrix.block(stencil[0]);
    if (!last) {
      const Cross sweep((0.5 * torque_[i] * inverse_length_[i] * inverse_length_[i]) * tangent_[i]);
      for (int c = 0; c < 3; ++c) edge[c] = here.ff[c] + after.ee[c] + sweep.column[c];
    } else {
      std::fill_n(edge, 3, Lanes{});
    }
    const Lanes own_spin = last ? Lanes{} : middle + after.by_e;
    for (int c = 0; c < 3; ++c)
      own.column[c] += edge_before[c] + edge[c] - here.ef[c] - here.fe[c] + own_spin[c] * kSpin;
    if (last) break;
    const auto j = static_cast<Eigen::Index>(i);
    const double spin = inertia_[j] / (dt_ * dt_) + drag_[j] / dt_ + rest_[j];
    own.column[3] += own_spin + (here.stiffness + after.stiffness + spin) * kSpin;
    const Lanes leans = spin * lean_[i], row = here.by_f - after.by_e + after.by_f;
    Block<4>&next = matrix.block(stencil[1]), &next_back = matrix.block(stencil[3]);
    for (int c = 0; c < 3; ++c) {
      own.column[c] += leans[c] * kSpin;
      next.column[c] += here.ef[c] + after.ef[c] - edge[c] + (row[c] - leans[c]) * kSpin;
      next_back.column[c] += here.fe[c] + after.fe[c] - edge[c] - after.by_e[c] * kSpin;
      edge_before[c] = edge[c];
    }
    next.column[3] -= after.by_e + after.stiffness * kSpin;
    next_back.column[3] += row - after.stiffness * kSpin;
    if (i + 1 == edges) continue;
    Block<4>&second = matrix.block(stencil[2]), &second_back = matrix.block(stencil[6]);
    for (int c = 0; c < 3; ++c) {
      second.column[c] -= after.ef[c] + after.by_f[c] * kSpin;
      second_back.column[c] -= after.fe[c];
    }
    second_back.column[3] -= after.by_f;
  }
  if (curved_) bending_.add_stiffness(system);
}

double FrameTerms::angle_change(const std::vector<Lanes>& change, int j) const {
  return held(j) ? 0.0 : change[at(j)][3] - dot(lean_[at(j)], change[at(j + 1)] - change[at(j)]);
}

double FrameTerms::largest_factor(const std::vector<Lanes>& change) const {
  double longest = 0.0;
  for (int j = 0; j < static_cast<int>(rod_.edges()); ++j)
    longest = std::max(longest, std::abs(angle_change(change, j)));
  return longest > kLongestTurn ? kLongestTurn / longest : 1.0;
}

void FrameTerms::move(const std::vector<Lanes>& change, double factor) {
  for (int j = 0; j < static_cast<int>(rod_.edges()); ++j) angle_[at(j)] += factor * angle_change(change, j);
}

void FrameTerms::commit(const std::vector<double>& tension, RodState& state) {
  const int edges = static_cast<int>(rod_.edges());
  carry_directors();
  for (int j = 0; j < edges; ++j) {
    state.twist_rate[j] = (angle_[at(j)] - start_->twist[j]) / dt_;
    state.twist[j] = angle_[at(j)];
  }
  for (int i = 1; i < edges; ++i) state.reference_twist[i - 1] = reference_twist_[at(i)];
  state.reference_director = director_;
  if (curved_) bending_.commit(tension, state);
}

FrameTerms::Energy FrameTerms::energy(const Points& increment, const std::vector<Lanes>& force) const {
  Energy out;
  const int edges = static_cast<int>(rod_.edges());
  const auto turn = [&](int j) { return angle_[at(j)] - start_->twist[j]; };
  const auto edge_change = [&](int j) { return to_lanes(Vec3(increment.col(j + 1) - increment.col(j))); };
  for (int i = 1; i < edges; ++i) {
    const double moment = moment_[at(i)], by_e = 0.5 * inverse_length_[at(i - 1)], by_f = 0.5 * inverse_length_[at(i)];
    if (stiffness_[at(i)] > 0.0) out.twisting += 0.5 * moment * moment / stiffness_[at(i)];
    out.along +=
        moment * (dot(binormal_[at(i)], by_e * edge_change(i - 1) + by_f * edge_change(i)) + turn(i) - turn(i - 1));
  }
  if (curved_) {
    const FrameBending::Energy bending = bending_.energy(increment, angle_, start_->twist);
    out.bending = bending.stored;
    out.plastic = bending.dissipated;
    out.along += bending.along;
  }
  for (int j = 0; j < edges; ++j) {
    const double turned = turn(j), rate = turned / dt_, change = rate - start_->twist_rate[j];
    if (!held(j)) out.residual += force[at(j)][3] * turned;
    out.drag += drag_[j] * rate * turned;
    out.rest += rest_[j] * turned * turned;
    out.inertia += 0.5 * inertia_[j] * change * change;
    out.kinetic += 0.5 * inertia_[j] * rate * rate;
    // What holds a frame has its inertia and drag in its torque.
    out.moment += (inertia_[j] * change / dt_ + drag_[j] * rate + rest_[j] * turned) * to_vec3(tangent_[at(j)]);
  }
  return out;
}

void FrameTerms::account(const SolvedStep& step, StepAccount& account) const {
  const Energy energy = this->energy(step.increment, step.force);
  account.energies.bending += energy.bending;
  account.energies.twisting += energy.twisting;
  account.energies.kinetic += energy.kinetic;
  account.loads.moment -= energy.moment;
  account.work.numerical += energy.along + energy.inertia + energy.rest - energy.plastic;
  account.work.plastic += energy.plastic;
  account.work.drag += energy.drag;
  account.work.residual += energy.residual;
}

}  // namespace knot_utm
