#include "knot_utm/contact/edge_contact.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

namespace {

// r over the product of the edges' lengths: acts where edges turn through parallel within about 0.1 rad. Elsewhere it
// draws the feet towards the middles by up to half of this fraction, which tilts the normal by 0.2 % at most.
constexpr double kRegularisation = 0.01;

constexpr double kSameContact = 1.5;     // arclength within which a contact is that of the last step [h]
constexpr double kLeastEstimate = 1e-6;  // of the pressure, in K delta

using Mat39 = Eigen::Matrix<double, 3, 9>;
using Row9 = Eigen::Matrix<double, 1, 9>;

}  // namespace

EdgeContact::EdgeContact(const RodProperties& rod, const NormalLaw& normal, const Friction& friction, double margin)
    : normal_{normal.stiffness, normal.tolerance},
      friction_(friction),
      diameter_(2.0 * rod.material.radius),
      window_(kSameContact * rod.material.radius),
      reach_((2.0 + kReachMargin) * rod.material.radius),
      least_prediction_(kLeastEstimate * normal_.stiffness * normal_.tolerance),
      rest_length_(rod.rest_length),
      length_(rod.rest_length),
      // Candidates are segments around nodes; an edge is found by the node it ends at, and is the whole of its extent.
      candidates_(rod, reach_, margin, least_loop(rod.material.radius), 1.0) {
  arclength_ = rod.arclength();
}

void EdgeContact::find_pairs() {
  const int last_node = static_cast<int>(arclength_.size()) - 2;
  pairs_.clear();
  auto add = [this](int a, int b) {
    if (arclength_[b] - arclength_[a + 1] >= candidates_.exclusion(a)) pairs_.push_back({a, b});
  };
  for (const int i : candidates_.segments())
    for (const Candidates::Run* run = candidates_.begin(i); run != candidates_.end(i); ++run)
      for (int j = std::max(run->first, i + 1); j <= run->last; ++j) {
        add(i - 1, j - 1);
        if (j == last_node) add(i - 1, j);  // the last edge ends at no inner node
      }
}

void EdgeContact::begin(const Points& start) {
  if (candidates_.refresh(start)) find_pairs();
  contacts_.clear();
  feet_.clear();
  first_evaluation_ = true;
}

void EdgeContact::evaluate(const Points& position, const Points& start, double dt) {
  prediction_.assign(pairs_.size(), -1.0);
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (contacts_[i].prediction > least_prediction_)
      prediction_[static_cast<std::size_t>(feet_[i].pair)] = contacts_[i].prediction;
  contacts_.clear();
  feet_.clear();
  moving_.clear();
  surfaces_.clear();
  length_ = (position.rightCols(length_.size()) - position.leftCols(length_.size())).colwise().norm();
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
    const auto [a, b] = pairs_[pair];
    const Vec3 apart = position.col(a) + position.col(a + 1) - position.col(b) - position.col(b + 1);
    const double limit = 2.0 * reach_ + length_[a] + length_[b];
    if (apart.squaredNorm() < limit * limit) add_contact(static_cast<int>(pair), position, start);
  }
  if (turns_) add_shifts(contacts_, surfaces_);
  evaluate_forces(friction_, dt, contacts_);
  if (turns_) set_couples(rolling_, contacts_, surfaces_);
  dt_ = dt;
  first_evaluation_ = false;
}

void EdgeContact::add_contact(int pair, const Points& position, const Points& start) {
  const auto [a, b] = pairs_[static_cast<std::size_t>(pair)];
  const Vec3 da = position.col(a + 1) - position.col(a), db = position.col(b + 1) - position.col(b);
  const double r = kRegularisation * rest_length_[a] * rest_length_[b];
  const ClosestPoints at = closest(a, b, position);

  ContactPoint contact;
  contact.x = position.col(a) + at.t * da - position.col(b) - at.u * db;
  contact.d = contact.x.norm();
  if (contact.d >= reach_) return;
  const int last_stencil = static_cast<int>(position.cols()) - 3;
  contact.a0 = std::min(a, last_stencil);
  contact.b0 = std::min(b, last_stencil);
  const int ka = a - contact.a0, kb = 3 + b - contact.b0;
  contact.c[ka] = 1.0 - at.t;
  contact.c[ka + 1] = at.t;
  contact.c[kb] = at.u - 1.0;
  contact.c[kb + 1] = -at.u;
  contact.beta[ka] = contact.beta[kb] = -1.0;
  contact.beta[ka + 1] = contact.beta[kb + 1] = 1.0;
  contact.arclength_a = arclength_[a] + at.t * rest_length_[a];
  contact.arclength_b = arclength_[b] + at.u * rest_length_[b];
  contact.n = contact.x / contact.d;
  contact.overlap = diameter_ - contact.d;
  contact.begins = normal_.begin();
  contact.weight = 0.5 * (rest_length_[a] + rest_length_[b]);
  contact.db = db;

  const Memory* found = recall({a, b}, contact.arclength_a, contact.arclength_b);
  contact.prediction = prediction_[static_cast<std::size_t>(pair)];
  if (first_evaluation_ && found && found->edges == std::pair{a, b} && found->pressure > least_prediction_)
    contact.prediction = found->pressure;

  Feet feet{pair, da, Vec3::Zero()};
  EdgeFeet moving;
  if (contact.active()) {
    const double aa = da.squaredNorm() + r, bb = db.squaredNorm() + r;
    if (at.t_free && at.u_free) {
      const double ab = da.dot(db), determinant = aa * bb - ab * ab;
      moving.inverse_tt = bb / determinant;
      moving.inverse_tu = ab / determinant;
      moving.inverse_uu = aa / determinant;
    } else if (at.t_free) {
      moving.inverse_tt = 1.0 / aa;
    } else if (at.u_free) {
      moving.inverse_uu = 1.0 / bb;
    }
    if (friction_.on()) {
      if (found) contact.memory = found->friction;
      contact.slip = contact.memory.slip;
      for (int k = 0; k < 6; ++k) {
        const int node = k < 3 ? contact.a0 + k : contact.b0 + k - 3;
        const Vec3 moved = position.col(node) - start.col(node);
        contact.slip += contact.c[k] * moved;
        (k < 3 ? feet.turn_a : contact.turn) += contact.beta[k] * moved;
      }
    }
  }
  contact.pressure = normal_.pressure(contact.overlap);
  if (turns_) add_surface(contact, feet, a, b);
  contacts_.push_back(contact);
  feet_.push_back(feet);
  moving_.push_back(moving);
}

void EdgeContact::add_surface(const ContactPoint& contact, const Feet& feet, int a, int b) {
  SurfacePoint& surface = surfaces_.emplace_back();
  if (!contact.active() || !friction_.on()) return;
  std::copy_n(contact.beta, 3, surface.d_a);
  surface.along_a = feet.da;
  surface.turn_a = feet.turn_a;
  const double length_a = turns_->length[static_cast<std::size_t>(a)];
  const double length_b = turns_->length[static_cast<std::size_t>(b)];
  surface.s_a[a - contact.a0] = length_a;
  surface.s_b[b - contact.b0] = length_b;
  surface.spin_a = length_a * turns_->turn[static_cast<std::size_t>(a)];
  surface.spin_b = length_b * turns_->turn[static_cast<std::size_t>(b)];
  surface.lever = lever_;
}

EdgePressure pressure_of(const EdgeLaw& normal, const ContactLinearisation& how, const ContactPoint& contact) {
  EdgePressure out;
  const double tangent_at = contact.prediction > 0.0 ? normal.overlap_at(contact.prediction) : contact.overlap;
  out.slope = normal.slope(tangent_at);
  out.pressure = normal.pressure(tangent_at) + out.slope * (contact.overlap - tangent_at);
  out.turning = how.predicts ? predicted_pressure(contact.prediction, out.pressure) : out.pressure;
  return out;
}

const EdgeContact::Memory* EdgeContact::recall(std::pair<int, int> edges, double arclength_a,
                                               double arclength_b) const {
  auto memory = std::lower_bound(memory_.begin(), memory_.end(), arclength_a - window_,
                                 [](const Memory& m, double arclength) { return m.arclength_a < arclength; });
  const Memory* found = nullptr;
  double nearest = window_;
  for (; memory != memory_.end() && memory->arclength_a <= arclength_a + window_; ++memory) {
    if (memory->edges == edges) return &*memory;
    const double away = std::hypot(memory->arclength_a - arclength_a, memory->arclength_b - arclength_b);
    if (away > nearest || (found && away == nearest)) continue;
    nearest = away;
    found = &*memory;
  }
  return found;
}

void EdgeContact::linearise(const ContactLinearisation& how, double dt, std::vector<EdgeContactModel>& models) const {
  models.clear();
  friction_.visit([&](const auto& law) {
    for (const ContactPoint& contact : contacts_)
      if (contact.active()) linearise_contact(contact, law, how, dt, models.emplace_back());
  });
}

template <typename Law>
void EdgeContact::linearise_contact(const ContactPoint& contact, const Law& law, const ContactLinearisation& how,
                                    double dt, EdgeContactModel& model) const {
  const Feet& feet = feet_[static_cast<std::size_t>(&contact - contacts_.data())];
  const EdgeFeet& moving = moving_[static_cast<std::size_t>(&contact - contacts_.data())];
  const EdgePressure of_law = pressure_of(normal_, how, contact);
  model.slope = of_law.slope;
  model.pressure = of_law.pressure;

  // Everything below is a linear map of (S, A, R).
  const Vec3& x = contact.x;
  const Vec3& n = contact.n;
  Row9 t, u;
  t << (moving.inverse_tu * contact.db - moving.inverse_tt * feet.da).transpose(), -moving.inverse_tt * x.transpose(),
      moving.inverse_tu * x.transpose();
  u << (moving.inverse_uu * contact.db - moving.inverse_tu * feet.da).transpose(), -moving.inverse_tu * x.transpose(),
      moving.inverse_uu * x.transpose();
  Mat39 moved = Mat39::Zero();
  moved.leftCols<3>().setIdentity();

  const Mat39 dx = moved + feet.da * t - contact.db * u;
  const Row9 dd = n.transpose() * dx;
  const Mat39 dn = (dx - n * dd) / contact.d;
  Vec3 direction = n, pressing = n;  // n - mu z and n + dt/dp
  Mat39 turned = dn;
  if (law.coefficient > 0.0) {
    const Vec3& r = contact.slip;
    const double along = n.dot(r);
    const FrictionTangent<Vec3> friction = law.tangent(friction_input(contact, dt), how.friction);
    direction -= friction.coefficient * friction.z;
    pressing -= friction.by_pressure;
    // d(P r) = -(n.r) dn - n (r.dn) + P dr
    const Mat39 dr = moved + feet.turn_a * t - contact.turn * u;
    const Mat39 tangential = dr - n * (n.transpose() * dr) - along * dn - n * (r.transpose() * dn);
    turned -= friction.stiffness * (friction.across * tangential +
                                    friction.along * friction.left * (friction.right.transpose() * tangential));
  }
  model.force = to_lanes(contact.weight * model.pressure * direction);
  const Mat39 dg = contact.weight * (of_law.turning * turned - model.slope * pressing * dd);

  for (int k = 0; k < 6; ++k) {
    const int turning = k < 3 ? 3 : 6;
    const double c = contact.c[k], beta = contact.beta[k];
    model.c[k] = c;
    model.moves[k] = k < 3 ? beta : -beta;
    model.force_by[k] = c * dg.leftCols<3>() + beta * dg.middleCols<3>(turning);
    model.t_by[k] = (c * t.leftCols<3>() + beta * t.middleCols<3>(turning)).transpose();
    model.u_by[k] = (c * u.leftCols<3>() + beta * u.middleCols<3>(turning)).transpose();
  }
}

ContactMotion EdgeContact::motion(const ContactPoint& contact, const Points& position, const Points& start) const {
  ContactMotion out;
  for (int k = 0; k < 6; ++k) {
    const int node = k < 3 ? contact.a0 + k : contact.b0 + k - 3;
    out.slip += contact.c[k] * (position.col(node) - start.col(node));
  }
  if (turns_) {
    const SurfacePoint& surface = surfaces_[static_cast<std::size_t>(&contact - contacts_.data())];
    out.rolling = rolling(contact, surface);
    out.passed_on = 2.0 * surface.lever;
  }
  const Feet& feet = feet_[static_cast<std::size_t>(&contact - contacts_.data())];
  const auto [a, b] = pairs_[static_cast<std::size_t>(feet.pair)];
  const ClosestPoints at = closest(a, b, start);
  const Vec3 x =
      start.col(a) + at.t * (start.col(a + 1) - start.col(a)) - start.col(b) - at.u * (start.col(b + 1) - start.col(b));
  out.overlap_before = diameter_ - x.norm();
  out.weight = out.weight_before = contact.weight;
  return out;
}

ClosestPoints EdgeContact::closest(int a, int b, const Points& position) const {
  return closest_points(position.col(a), position.col(a + 1) - position.col(a), position.col(b),
                        position.col(b + 1) - position.col(b), kRegularisation * rest_length_[a] * rest_length_[b]);
}

void EdgeContact::commit(const Points&) {
  memory_.clear();
  for (const ContactPoint& contact : contacts_) {
    if (!contact.touches()) continue;
    const auto number = static_cast<std::size_t>(&contact - contacts_.data());
    const Feet& feet = feet_[number];
    memory_.push_back({pairs_[static_cast<std::size_t>(feet.pair)], contact.arclength_a, contact.arclength_b,
                       rolling_.on() ? remember(friction_, rolling_, contact, surfaces_[number], dt_)
                                     : remember(friction_, contact, dt_),
                       contact.pressure});
  }
  std::stable_sort(memory_.begin(), memory_.end(),
                   [](const Memory& l, const Memory& r) { return l.arclength_a < r.arclength_a; });
}

void EdgeContact::Memory::state(Archive& archive) { archive(edges, arclength_a, arclength_b, friction, pressure); }

void EdgeContact::state(Archive& archive) {
  archive.section("EDG2");  // "EDGE" had no number that a friction law keeps
  archive(candidates_);
  archive.list(memory_);
  if (rolling_.on()) {
    archive.section("ROL2");  // before there was none, and a vector for each
    for (Memory& memory : memory_) archive(memory.friction.rolled);
  }
  if (archive.loads()) find_pairs();
}

}  // namespace knot_utm
