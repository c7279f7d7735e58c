#include "knot_utm/sim/frame_terms.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "knot_utm/numeric/fours.hpp"
#include "knot_utm/numeric/index.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/rod/thinned.hpp"
#include "knot_utm/sim/force_term.hpp"

namespace knot_utm {
namespace {

// Well above the rounding of the factorisation, far below anything that twists: over a thousand edges, a millionth of
// the stiffness of one.
constexpr double kRest = 1e-9;        // r_j [k_t/l_j]
constexpr double kLongestTurn = 0.5;  // of an edge in one iteration [rad]

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
  if (!any(~small)) return out;
  for (int k = 0; k < 4; ++k)
    if (!(size[k] < 0.1 * turn.w[k])) out[k] = std::remainder(2.0 * std::atan2(sine[k], turn.w[k]), 2.0 * M_PI);
  return out;
}

/// Directors d1 of the tangents `from`, transported to `to` as transported_director does.
FourVectors transported(const FourVectors& d1, const FourVectors& from, const FourVectors& to) {
  const FourVectors sum = from + to;
  const Lanes half_squared = 0.5 * dot(sum, sum);
  const FourVectors carried = d1 - (dot(sum, d1) / half_squared) * sum + (2.0 * dot(from, d1)) * to;
  const FourVectors across = carried - dot(carried, to) * to;
  FourVectors out = (1.0 / square_root(dot(across, across))) * across;
  constexpr double kNearlyOpposite = 1e-12;
  if (any(half_squared < kNearlyOpposite)) {
    for (int k = 0; k < 4; ++k) {
      const auto one = [&](const FourVectors& of) { return Vec3(of.x[k], of.y[k], of.z[k]); };
      const Vec3 exact = transported_director(one(d1), one(from), one(to));
      out.x[k] = exact[0];
      out.y[k] = exact[1];
      out.z[k] = exact[2];
    }
  }
  return out;
}

/// Sets the tangents of pairs from those of the edges, which come in fours.
void set_tangents_of(std::vector<FourPairs>& pairs, const std::vector<FourVectors>& tangent) {
  for (std::size_t g = 0; g < pairs.size(); ++g) {
    pairs[g].u = tangent[g];
    pairs[g].v = one_earlier(tangent[g], tangent[g + 1]);
  }
}

/// At its ends a cut edge goes on as the rope does there. It may lie back along a rope, a turn that no curvature has.
void straighten_cuts(const std::vector<int>& cuts, std::vector<FourPairs>& pairs) {
  const auto copy = [](const FourVectors& from, FourVectors& to, int lane) {
    to.x[lane] = from.x[lane];
    to.y[lane] = from.y[lane];
    to.z[lane] = from.z[lane];
  };
  for (const int cut : cuts) {
    if (cut > 0) copy(pairs[at(cut - 1) / 4].u, pairs[at(cut - 1) / 4].v, (cut - 1) % 4);
    if (at(cut) / 4 < pairs.size()) copy(pairs[at(cut) / 4].v, pairs[at(cut) / 4].u, cut % 4);
  }
}

}  // namespace

FrameTerms::FrameTerms(const RodProperties& rod, const StepSettings& settings, const HalfTurn* image)
    : rod_(rod),
      bending_(rod),
      rolls_(settings.friction_couple > 0.0),
      image_(image),
      held_(static_cast<std::size_t>(rod.nodes()), 0),
      start_tangent_(held_.size() + 3, Lanes{1.0, 0.0, 0.0, 0.0}),
      edge_(start_tangent_),
      tangent_(start_tangent_),
      inverse_length_(start_tangent_.size(), 1.0),
      lean_(start_tangent_.size()),
      turns_(image ? at(image->nodes) : start_tangent_.size()),
      stiffness_(start_tangent_.size(), 0.0),
      angle_(start_tangent_.size(), 0.0),
      spin_(start_tangent_.size(), 0.0),
      kept_spin_(start_tangent_.size(), 0.0),
      start_twist_(start_tangent_.size(), 0.0),
      reference_twist_(start_tangent_.size(), 0.0),
      torque_(start_tangent_.size(), 0.0),
      start_fours_((held_.size() + 2) / 4 + 1, four(start_tangent_, 0)),
      tangent_fours_(start_fours_),
      start_director_(start_fours_.size(), FourVectors{Lanes{}, constant<Lanes>(1.0), Lanes{}}),
      director_(start_director_),
      start_pairs_(start_fours_.size() - 1),
      pairs_(start_pairs_),
      twists_(start_pairs_.size()),
      slopes_(start_pairs_.size()) {
  const double counts = settings.spin_inertia ? 1.0 : 0.0;
  for (Eigen::VectorXd* each : {&inertia_, &drag_, &rest_}) each->resize(rod.edges());
  for (Eigen::Index j = 0; j < rod.edges(); ++j) {
    const RodMaterial& of = rod.material_at(j);
    const double h2 = of.radius * of.radius;
    inertia_[j] = (counts * 0.5 * of.density * M_PI * h2 * h2) * rod.rest_length[j];
    drag_[j] = (counts * settings.drag * h2) * rod.rest_length[j];
    rest_[j] = ((1.0 - counts) * kRest * of.twisting_stiffness) * (1.0 / rod.rest_length[j]);
  }
  take_lengths();
}

void FrameTerms::take_lengths() {
  for (int i = 1; i + 1 < static_cast<int>(rod_.nodes()); ++i)
    stiffness_[at(i)] = rod_.material_at(i).twisting_stiffness / rod_.voronoi_length[i];
  for (const int cut : cuts_) stiffness_[at(cut)] = stiffness_[at(cut + 1)] = 0.0;
}

void FrameTerms::part(int edge) {
  bending_.part(edge);
  cuts_.push_back(edge);
  stiffness_[at(edge)] = stiffness_[at(edge + 1)] = 0.0;
}

void FrameTerms::begin(const StepStart& step, bool) {
  const RodState& start = step.state;
  start_ = &start;
  curved_ = start.curved_at_rest();
  dt_ = step.dt;
  if (curved_) bending_.begin(start, dt_);
  const int edges = static_cast<int>(rod_.edges());
  if (rod_.material.is_soft()) {
    take_lengths();
    for (int i = 1; i < edges; ++i) stiffness_[at(i)] *= thinned(rod_, start.position, i).twisting;
  }
  for (int j = 0; j < edges; ++j) {
    start_tangent_[at(j)] = to_lanes(Vec3((start.position.col(j + 1) - start.position.col(j)).normalized()));
    angle_[at(j)] = start.twist[j] + dt_ * start.twist_rate[j];
    kept_spin_[at(j)] = inertia_[j] * start.twist_rate[j] / dt_;
    spin_[at(j)] = inertia_[j] / (dt_ * dt_) + drag_[j] / dt_ + rest_[j];
  }
  for (int j = 0; j < edges; ++j) {
    FourVectors& directors = start_director_[at(j / 4)];
    directors.x[j % 4] = start.reference_director(0, j);
    directors.y[j % 4] = start.reference_director(1, j);
    directors.z[j % 4] = start.reference_director(2, j);
  }
  for (std::size_t g = 0; g + 1 < start_fours_.size(); ++g) start_fours_[g] = four(start_tangent_, 4 * g);
  set_tangents_of(start_pairs_, start_fours_);
  straighten_cuts(cuts_, start_pairs_);
  for (int i = 1; i < edges; ++i) {
    reference_twist_[at(i)] = start.reference_twist[i - 1];
    start_twist_[at(i)] = start.reference_twist[i - 1];
  }
  std::fill(held_.begin(), held_.end(), 0);
  held_.back() = 1;
  for (const FixedTwist& fixed : step.boundary.fixed_twists) {
    held_[at(fixed.edge)] = 1;
    angle_[at(fixed.edge)] = fixed.angle;
  }
}

void FrameTerms::mirror(const FrameTerms& half, const HalfTurn& image) {
  const auto turn = [&](int j) { return half.angle_[at(j)] - start_->twist[j]; };
  for (int j = 0; j < static_cast<int>(rod_.edges()); ++j)
    if (!held(j)) angle_[at(j)] = start_->twist[j] + (j < image.half() ? turn(j) : -turn(image.image_of_edge(j)));
}

int FrameTerms::nodes_of(std::size_t group) const {
  return static_cast<int>(std::min<std::size_t>(4, held_.size() - 2 - 4 * group));
}

void FrameTerms::set_tangents(const Points& position) {
  const std::size_t edges = static_cast<std::size_t>(rod_.edges());
  for (std::size_t j = 0; j < edges; ++j) {
    const double* x = position.data() + 3 * j;
    edge_[j] = Lanes{x[3] - x[0], x[4] - x[1], x[5] - x[2], 0.0};
  }
  for (std::size_t g = 0; 4 * g < edges; ++g) {
    const FourVectors e = four(edge_, 4 * g), &before = start_fours_[g];
    const Lanes length = square_root(dot(e, e)), over_e = 1.0 / length;
    const FourVectors now = over_e * e;
    tangent_fours_[g] = now;
    put(over_e, inverse_length_, 4 * g);
    put(now, tangent_, 4 * g);
    if (rolls_) put(length, turns_.length, 4 * g);
    put(over_e / (1.0 + dot(before, now)) * cross(now, before), lean_, 4 * g);
  }
  set_tangents_of(pairs_, tangent_fours_);
  straighten_cuts(cuts_, pairs_);
  for (std::size_t g = 0; g < pairs_.size(); ++g) {
    pairs_[g].over_e = four(inverse_length_, 4 * g);
    pairs_[g].over_f = four(inverse_length_, 4 * g + 1);
  }
}

/// m_ref, b, chi and the moment of every inner node.
void FrameTerms::set_twist() {
  for (std::size_t g = 0; g < pairs_.size(); ++g) {
    const std::size_t i = 4 * g + 1;
    const FourVectors &e = pairs_[g].u, &f = pairs_[g].v, &e_n = start_pairs_[g].u, &f_n = start_pairs_[g].v;
    const Turns e_to_f = transport(e, f);
    // Back from f to e as the conjugate; behind the last node there are no edges, and nothing is read.
    const Turns around = transport(e_n, f_n) * transport(e, e_n) * Turns{e_to_f.w, -1.0 * e_to_f.v} * transport(f_n, f);
    const Lanes turned = angle_about(f_n, around), over_chi = 1.0 / e_to_f.w;
    const Lanes twist = four(angle_, i) - four(angle_, i - 1) + four(start_twist_, i) + turned;
    const Lanes stiffness = four(stiffness_, i);
    twists_[g] = {2.0 * over_chi * e_to_f.v, over_chi, stiffness, stiffness * twist};
    put(turned, reference_twist_, i);
  }
  for (std::size_t i = 1; i + 1 < held_.size(); ++i)
    reference_twist_[i] += start_->reference_twist[static_cast<Eigen::Index>(i) - 1];
}

/// m_e = b/(2 |e|), m_f = b/(2 |f|).
FourSlopes FrameTerms::twist_slopes(std::size_t group) const {
  const FourTwists& twist = twists_[group];
  const Lanes half = 0.5 * twist.moment, by_e = half * pairs_[group].over_e, by_f = half * pairs_[group].over_f;
  FourSlopes out;
  for (int r = 0; r < 3; ++r) {
    out.of[kOfE + r] = by_e * twist.binormal[r];
    out.of[kOfF + r] = by_f * twist.binormal[r];
  }
  out.of[kThetaE] = -twist.moment;
  out.of[kThetaF] = twist.moment;
  return out;
}

void FrameTerms::carry_directors() {
  for (std::size_t g = 0; g + 1 < director_.size(); ++g)
    director_[g] = transported(start_director_[g], start_fours_[g], tangent_fours_[g]);
}

void FrameTerms::add_elastic_forces(std::vector<Lanes>& force) {
  for (std::size_t g = 0; g < pairs_.size(); ++g) slopes_[g] = twist_slopes(g);
  if (curved_) {
    carry_directors();
    bending_.evaluate(pairs_, director_, angle_, slopes_);
  }
  std::fill(torque_.begin(), torque_.end(), 0.0);
  for (std::size_t g = 0; g < pairs_.size(); ++g) {
    const int count = nodes_of(g);
    subtract_slopes(slopes_[g], static_cast<int>(4 * g + 1), count, force);
    for (int k = 0; k < count; ++k) {
      torque_[4 * g + at(k)] += slopes_[g].of[kThetaE][k];
      torque_[4 * g + at(k) + 1] += slopes_[g].of[kThetaF][k];
    }
  }
}

void FrameTerms::add_forces(const StepStart&, const Points& x, std::vector<Lanes>& force) {
  const int edges = static_cast<int>(rod_.edges());
  set_tangents(x);
  set_twist();
  add_elastic_forces(force);
  for (int j = 0; j < edges; ++j) {
    const double turned = angle_[at(j)] - start_->twist[j];
    if (rolls_) set_turn(at(j), turned);
    force[at(j)][3] -= spin_[at(j)] * turned - kept_spin_[at(j)];
  }
  if (rolls_ && image_) turn_images();
}

void FrameTerms::turn_images() {
  for (int j = image_->half(); j + 1 < image_->nodes; ++j) {
    const std::size_t there = at(j), own = at(image_->image_of_edge(j));
    turns_.turn[there] = -turns_.turn[own];
    turns_.length[there] = turns_.length[own];
    turns_.tangent[there] = -(*image_ * turns_.tangent[own]);
    turns_.pull[there] = *image_ * turns_.pull[own];
  }
}

void FrameTerms::set_turn(std::size_t j, double turned) {
  turns_.turn[j] = turned;
  turns_.tangent[j] = tangent_[j];
  turns_.pull[j] = lean_[j] - (turned * inverse_length_[j]) * tangent_[j];
}

TwistingInput FrameTerms::twisting_input(int i) const {
  return {stiffness_[at(i)] * rod_.voronoi_length[i], rod_.voronoi_length[i]};
}

double FrameTerms::twist(int i) const { return angle_[at(i)] - angle_[at(i - 1)] + reference_twist_[at(i)]; }

FrameTerms::NodeStiffness FrameTerms::node_stiffness(int i) const {
  NodeStiffness out = NodeStiffness::Zero();
  auto elastic = out.topLeftCorner<kStencilSize, kStencilSize>();
  elastic = twisting(twisting_input(i), to_vec3(edge_[at(i - 1)]), to_vec3(edge_[at(i)]), twist(i)).hessian;
  if (curved_) elastic += bending_.hessian(pairs_[at(i - 1) / 4], i);
  return out;
}

FrameTerms::EdgeStiffness FrameTerms::edge_stiffness(int j) const {
  EdgeStiffness out;
  const Lanes w = (0.5 * torque_[at(j)] * inverse_length_[at(j)] * inverse_length_[at(j)]) * tangent_[at(j)];
  out.sweep << 0.0, -w[2], w[1], w[2], 0.0, -w[0], -w[1], w[0], 0.0;
  out.spin = spin_[at(j)];
  out.lean = lean(j);
  return out;
}

/// With t = mean and s_e = u + t, the Hessian of twisting.hpp by its right factors b and s.
FourCurves FrameTerms::twist_curves(std::size_t group) const {
  const FourTwists& twist = twists_[group];
  const FourPairs& pair = pairs_[group];
  const FourVectors &b = twist.binormal, &u = pair.u, &v = pair.v;
  const Lanes &k = twist.stiffness, half_e = 0.5 * pair.over_e, half_f = 0.5 * pair.over_f;
  const FourVectors mean = twist.over_chi * (u + v), by_e = (k * half_e) * b, by_f = (k * half_f) * b;
  const Lanes turn_e = twist.moment * half_e * half_e, turn_f = twist.moment * half_f * half_f;
  const Lanes turn_ef = 2.0 * twist.moment * half_e * half_f;
  const FourVectors on_s_e = turn_e * (u + mean), on_s_f = turn_f * (v + mean), ef_mean = turn_ef * b;
  const FourVectors ee_b = half_e * by_e - on_s_e, ff_b = half_f * by_f - on_s_f, both = half_f * by_e;
  const FourVectors w = (2.0 * twist.over_chi * turn_ef) * u;
  const Lanes none = {};
  const Lanes across[3][3] = {{none, -w.z, w.y}, {w.z, none, -w.x}, {-w.y, w.x, none}};
  FourCurves out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      out.of[kOfE + i][kOfF + j] = both[i] * b[j] - ef_mean[i] * mean[j] + across[i][j];
      if (j < i) continue;
      out.of[kOfE + i][kOfE + j] = ee_b[i] * b[j] - b[i] * on_s_e[j];
      out.of[kOfF + i][kOfF + j] = ff_b[i] * b[j] - b[i] * on_s_f[j];
    }
    out.of[kOfE + i][kThetaE] = -by_e[i];
    out.of[kOfE + i][kThetaF] = by_e[i];
    out.of[kThetaE][kOfF + i] = -by_f[i];
    out.of[kOfF + i][kThetaF] = by_f[i];
  }
  out.of[kThetaE][kThetaE] = out.of[kThetaF][kThetaF] = k;
  out.of[kThetaE][kThetaF] = -k;
  return out;
}

/// As edge_stiffness, of the edges behind four nodes.
FourEdges FrameTerms::edges_behind(std::size_t group) const {
  const std::size_t j = 4 * group + 1;
  const Lanes& over_f = pairs_[group].over_f;
  return {(0.5 * four(torque_, j) * over_f * over_f) * pairs_[group].v, four(spin_, j), four(lean_, j)};
}

void FrameTerms::add_first_edge(StepMatrix<4>& matrix) const {
  const EdgeStiffness edge = edge_stiffness(0);
  for (int c = 0; c < 3; ++c) {
    const Lanes sweep = to_lanes(Vec3(edge.sweep.col(c))), leans = (edge.spin * edge.lean[c]) * kSpin;
    matrix.band(0, 0, 0).column[c] += sweep + leans;
    matrix.band(0, 0, 1).column[c] -= sweep + leans;
    matrix.band(0, 1, 0).column[c] -= sweep;
    matrix.band(0, 1, 1).column[c] += sweep;
  }
  matrix.band(0, 0, 0).column[3] += edge.spin * kSpin;
}

void FrameTerms::add_stiffness(LinearSystem<4>& system) const {
  add_first_edge(system.matrix);
  for (std::size_t g = 0; g < pairs_.size(); ++g) {
    FourCurves curves = twist_curves(g);
    if (curved_) bending_.add_stiffness(pairs_[g], g, curves);
    add_curves(curves, edges_behind(g), static_cast<int>(4 * g + 1), nodes_of(g), system.matrix);
  }
  if (curved_) bending_.add_beyond(system.right);
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

void FrameTerms::write(const std::vector<double>& tension, RodState& state) {
  const int edges = static_cast<int>(rod_.edges());
  if (!curved_) carry_directors();
  for (int j = 0; j < edges; ++j) {
    state.twist_rate[j] = (angle_[at(j)] - start_->twist[j]) / dt_;
    state.twist[j] = angle_[at(j)];
  }
  for (int i = 1; i < edges; ++i) state.reference_twist[i - 1] = reference_twist_[at(i)];
  for (int j = 0; j < edges; ++j) {
    const FourVectors& directors = director_[at(j / 4)];
    state.reference_director.col(j) << directors.x[j % 4], directors.y[j % 4], directors.z[j % 4];
  }
  if (curved_) bending_.commit(tension, state);
}

FrameTerms::Energy FrameTerms::energy(const Points& increment, const std::vector<Lanes>& force) const {
  Energy out;
  const int edges = static_cast<int>(rod_.edges());
  const auto turn = [&](int j) { return angle_[at(j)] - start_->twist[j]; };
  for (int i = 1; i < edges; ++i) {
    const std::size_t g = at(i - 1) / 4;
    const int k = (i - 1) % 4;
    const double moment = twists_[g].moment[k];
    if (stiffness_[at(i)] > 0.0) out.twisting += 0.5 * moment * moment / stiffness_[at(i)];
    const Lanes* slope = slopes_[g].of;
    for (int r = 0; r < 3; ++r)
      out.along += slope[kOfE + r][k] * (increment(r, i) - increment(r, i - 1)) +
                   slope[kOfF + r][k] * (increment(r, i + 1) - increment(r, i));
    out.along += slope[kThetaE][k] * turn(i - 1) + slope[kThetaF][k] * turn(i);
  }
  if (curved_) {
    const FrameBending::Energy bending = bending_.energy();
    out.bending = bending.stored;
    out.plastic = bending.dissipated;
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
