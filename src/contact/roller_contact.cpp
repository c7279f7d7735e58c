#include "knot_utm/contact/roller_contact.hpp"

#include <algorithm>
#include <string>

#include "knot_utm/contact/centreline_curve.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {
namespace {

std::size_t memory_index(Eigen::Index nodes, std::size_t roller, int segment, int point) {
  return 2 * (roller * static_cast<std::size_t>(nodes) + static_cast<std::size_t>(segment)) +
         static_cast<std::size_t>(point);
}

}  // namespace

BesideRoller beside(const Roller& roller, const Vec3& place) {
  const Vec3 away = place - roller.centre;
  const Vec3 along = roller.axis * roller.axis.dot(away);
  if (roller.ring == 0.0) return {away - along, roller.axis};
  const Vec3 across = away - along;
  const double rho = across.norm();
  if (rho == 0.0) return {away - roller.ring * roller.axis.unitOrthogonal(), Vec3::Zero()};  // nearest to all sections
  const Vec3 outwards = across / rho;
  return {away - roller.ring * outwards, std::sqrt(roller.ring / rho) * roller.axis.cross(outwards)};
}

RollerContact::RollerContact(const RodProperties& rod, const NormalLaw& normal, const Friction& friction,
                             double farthest)
    : laws_(normal, friction),
      first_of_other_(static_cast<int>(rod.first_of_other())),
      radius_{rod.material.radius, rod.other_material.value_or(rod.material).radius},
      farthest_(farthest),
      voronoi_(rod.voronoi_length),
      nodes_(static_cast<int>(rod.nodes())) {}

std::size_t RollerContact::index_of(const ContactPoint& contact) const {
  return memory_index(voronoi_.size(), static_cast<std::size_t>(contact.roller), contact.a0 + 1, contact.point);
}

void RollerContact::begin(const std::vector<Roller>& rollers, const Points& start) {
  contacts_.clear();
  prediction_ = committed_prediction_;
  // Before the first accepted step there is nowhere to come from: what a rejected one took for that does not count.
  if (committed_prediction_.empty()) start_.clear();
  if (start_.size() != rollers.size()) {
    start_ = rollers;
    prediction_.assign(2 * rollers.size() * static_cast<std::size_t>(start.cols()), -1.0);
    memory_.assign(2 * rollers.size() * static_cast<std::size_t>(start.cols()), FrictionMemory());
  }
  find_near_segments(rollers, start);
}

void RollerContact::evaluate(const std::vector<Roller>& rollers, const Points& position, const Points& start,
                             double dt) {
  for (const ContactPoint& contact : contacts_) prediction_[index_of(contact)] = contact.prediction;
  contacts_.clear();
  surfaces_.clear();
  soft_.clear();
  dt_ = dt;
  for (const auto& [roller, segment] : near_)
    if (beside(rollers[roller], position.col(segment)).x.norm() <= limit(rollers[roller], segment))
      add_contacts(rollers, roller, segment, position, start);
  if (turns_) add_shifts(contacts_, surfaces_);
  evaluate_forces(laws_, dt, contacts_);
  if (turns_) set_couples(rolling_, contacts_, surfaces_);
  if (soft()) add_thinning(laws_, contacts_, surfaces_, soft_);
}

bool RollerContact::reaches_into_cut(int segment) const {
  return std::any_of(cuts_.begin(), cuts_.end(), [&](int cut) { return segment == cut || segment == cut + 1; });
}

double RollerContact::limit(const Roller& roller, int segment) const {
  return roller.radius + radius(segment) + voronoi_[segment];
}

void RollerContact::find_near_segments(const std::vector<Roller>& rollers, const Points& start) {
  near_.clear();
  for (std::size_t roller = 0; roller < rollers.size(); ++roller)
    for (int segment = 1; segment + 1 < nodes_; ++segment) {
      if (reaches_into_cut(segment)) continue;
      if (segment < rollers[roller].first_node || segment > rollers[roller].last_node) continue;
      if (beside(rollers[roller], start.col(segment)).x.norm() <= limit(rollers[roller], segment) + farthest_)
        near_.push_back({roller, segment});
    }
}

void RollerContact::add_contacts(const std::vector<Roller>& rollers, std::size_t number, int segment,
                                 const Points& position, const Points& start) {
  const Roller& roller = rollers[number];
  for (int point = 0; point < 2; ++point) {
    const PointWeights w(kIntegrationPoints[point], PointWeights::kWhole);
    const std::size_t memory = memory_index(position.cols(), number, segment, point);
    ContactPoint contact;
    const BesideRoller there = beside(roller, combine(w.value, position, segment));
    contact.x = there.x;
    contact.d = contact.x.norm();
    contact.overlap = roller.radius + radius(segment) - contact.d;
    SoftPoint soft_point;
    double stretch = 1.0;
    if (soft()) {
      const Eigen::VectorXd& lengths = *rest_length_;
      const double u = kIntegrationPoints[point], rest = (1.0 - u) * lengths[segment - 1] + u * lengths[segment];
      stretch = combine(SegmentWeights(u).derivative, position, segment).norm() / rest;
      soft_point = SoftPoint::of(radius(segment), stretch, 0.0, 1.0);
      contact.overlap = soft_point.sum - soft_point.scale * (contact.d - roller.radius);
    }
    contact.pair = pair_of(segment);
    contact.begins = laws_[contact.pair].normal.begin();
    contact.prediction = prediction_[memory];
    if (!contact.active()) continue;
    contact.a0 = segment - 1;
    contact.point = point;
    contact.roller = static_cast<int>(number);
    contact.axis = there.axis;
    contact.n = contact.x / contact.d;
    contact.weight = 0.5 * voronoi_[segment];
    if (soft()) {
      contact.weight *= stretch / soft_point.scale;
      soft_.push_back(soft_point);
    }
    const bool rubs = laws_[contact.pair].friction.on();
    if (rubs) contact.memory = memory_[memory];
    contact.slip = contact.memory.slip - (roller.centre - start_[number].centre);
    for (int k = 0; k < 3; ++k) {
      contact.c[k] = w.value[k];
      contact.slip += w.value[k] * (position.col(segment - 1 + k) - start.col(segment - 1 + k));
    }
    if (turns_) add_surface(contact, roller, position, start);
    contacts_.push_back(contact);
  }
}

void RollerContact::add_surface(const ContactPoint& contact, const Roller& roller, const Points& position,
                                const Points& start) {
  SurfacePoint& surface = surfaces_.emplace_back();
  if (!laws_[contact.pair].friction.on() && !soft()) return;
  const double u = kIntegrationPoints[contact.point];
  const SegmentWeights weights(u);
  std::copy_n(weights.derivative, 3, surface.d_a);
  surface.along_a = combine(weights.derivative, position, contact.a0 + 1);
  surface.turn_a = surface.along_a - combine(weights.derivative, start, contact.a0 + 1);
  for (int j = 0; j < 2; ++j) {
    const auto edge = static_cast<std::size_t>(contact.a0 + j);
    surface.s_a[j] = (j == 0 ? 1.0 - u : u) * turns_->length[edge];
    surface.spin_a += surface.s_a[j] * turns_->turn[edge];
  }
  const double h = radius(contact.a0 + 1);
  surface.lever = soft() ? 1.0 - roller.radius / contact.d : couple_ * h / (roller.radius + h);
}

double RollerContact::lever_of(const ContactPoint& contact) const {
  return turns_ ? surfaces_[static_cast<std::size_t>(&contact - contacts_.data())].lever : 0.0;
}

Vec3 RollerContact::couple_of(const ContactPoint& contact) const {
  return turns_ ? surfaces_[static_cast<std::size_t>(&contact - contacts_.data())].couple : Vec3(Vec3::Zero());
}

Vec3 RollerContact::force_on(int roller) const {
  Vec3 sum = Vec3::Zero();
  for (const ContactPoint& contact : contacts_)
    if (contact.roller == roller) sum -= contact.force;
  return sum;
}

Vec3 RollerContact::moment_on(const Roller& roller, int number, const Points& position) const {
  Vec3 sum = Vec3::Zero();
  for (const ContactPoint& contact : contacts_)
    if (contact.roller == number) {
      const Vec3 place = combine(contact.c, position, contact.a0 + 1) - roller.centre - lever_of(contact) * contact.x;
      sum -= place.cross(contact.force) + couple_of(contact);
    }
  return sum;
}

ContactMotion RollerContact::motion(const ContactPoint& contact, const Points&, const Points& start) const {
  ContactMotion out;
  const Vec3 carried = carried_along(contact);
  out.slip = contact.slip - contact.memory.slip + carried;
  if (turns_) {
    const SurfacePoint& surface = surfaces_[static_cast<std::size_t>(&contact - contacts_.data())];
    out.rolling = rolling(contact, surface);
    out.slip -= surface_shift(contact, surface);
  }
  out.rolling -= carried;
  const Vec3 place = combine(contact.c, start, contact.a0 + 1);
  const Vec3 x = beside(start_[static_cast<std::size_t>(contact.roller)], place).x;
  out.overlap_before = contact.overlap + contact.d - x.norm();
  out.weight = out.weight_before = contact.weight;
  if (soft()) {
    const auto number = static_cast<std::size_t>(&contact - contacts_.data());
    add_thinning(contact, surfaces_[number], soft_[number], x.norm(), out);
  }
  return out;
}

void RollerContact::commit(const std::vector<Roller>& rollers) {
  start_ = rollers;
  std::fill(prediction_.begin(), prediction_.end(), -1.0);
  for (const ContactPoint& contact : contacts_) prediction_[index_of(contact)] = contact.pressure;
  committed_prediction_ = prediction_;
  if (!laws_.rub()) return;
  std::fill(memory_.begin(), memory_.end(), FrictionMemory());
  for (const ContactPoint& contact : contacts_)
    memory_[index_of(contact)] = rolling_.on()
                                     ? remember(laws_[contact.pair].friction, rolling_, contact,
                                                surfaces_[static_cast<std::size_t>(&contact - contacts_.data())], dt_)
                                     : remember(laws_[contact.pair].friction, contact, dt_);
}

void RollerContact::state(Archive& archive) {
  archive.section("ROL4");  // "ROL3" had rollers that turn
  bool committed = !committed_prediction_.empty();
  archive(committed);
  // Before, what stands here is what a rejected step took for it.
  if (!committed) start_.clear();
  archive.list(start_);
  if (!committed) {
    archive.require(start_.empty(), "rollers", std::to_string(start_.size()));
    committed_prediction_.clear();
    memory_.clear();
    return;
  }
  archive.list(committed_prediction_);
  archive.list(memory_);
  if (rolling_.on()) {
    archive.section("ROL2");  // before there was none, and a vector for each
    for (FrictionMemory& memory : memory_) archive(memory.rolled);
  }
  const std::size_t places = memory_index(voronoi_.size(), start_.size(), 0, 0);
  archive.require(places > 0 && committed_prediction_.size() == places && memory_.size() == places, "places on rollers",
                  std::to_string(memory_.size()));
}

}  // namespace knot_utm
