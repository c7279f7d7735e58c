#include "knot_utm/contact/smooth_contact.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "knot_utm/numeric/index.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {
namespace {

// Motion of a node since the last search after which feet are searched again [h]. Two strands approach each other by
// less than the reach of the search exceeds the distance of contact.
constexpr double kFarSinceSearch = 0.1;
static_assert(2.0 * kFarSinceSearch < kReachMargin);
constexpr double kSharpest = 2.0;  // turn of the centreline at a node that is no longer resolved [rad]
constexpr double kSameFoot = 1.0;  // arclength within which a foot is that of the last step [h]
constexpr double kDeepest = 0.5;   // overlap of a contact of round sections that may begin [fraction of radius]
constexpr double kFading = 0.25;   // way to the end of the spline on which a foot loses its weighting factor [radii]
// Least G that a foot's motion is linearised with [|b'|^2]. Newton's method needs the foot's own G, since a couple
// moves along the strand with the foot. Friction on the centrelines hardly feels it, and keeps the bits it always had.
constexpr double kLeastG = 1e-6, kLeastGOnCentrelines = 1e-3;

/// Arclength at rest of parameter u on a segment: from the middle of one edge to the middle of the next.
double arclength_at(const Eigen::VectorXd& arclength, int segment, double u) {
  const double begin = 0.5 * (arclength[segment - 1] + arclength[segment]);
  const double end = 0.5 * (arclength[segment] + arclength[segment + 1]);
  return begin + u * (end - begin);
}

/// max(0, g) of x against the curve at parameter u of a segment: g = 1 - x.c''/|c'|^2 of the segment itself at its
/// middle, the smaller of the two that meet at its ends, linear between.
double least_curvature_factor(const Points& nodes, int segment, double u, const Vec3& x, double length2) {
  const int last = static_cast<int>(nodes.cols()) - 2;
  const double own = 1.0 - x.dot(second_difference(nodes, segment)) / length2;
  const int other = u < 0.5 ? std::max(segment - 1, 1) : std::min(segment + 1, last);
  const double end = std::min(own, 1.0 - x.dot(second_difference(nodes, other)) / length2);
  const double towards_end = 2.0 * std::abs(u - 0.5);
  return std::max(0.0, own + towards_end * (end - own));
}

}  // namespace

SmoothContact::SmoothContact(const RodProperties& rod, const NormalLaw& normal, const Friction& friction, double margin,
                             double catch_up)
    : laws_(normal, friction),
      first_of_other_(static_cast<int>(rod.first_of_other())),
      radius_{rod.material.radius, rod.other_material.value_or(rod.material).radius},
      distance_{2.0 * radius_[0], radius_[0] + radius_[1], 2.0 * radius_[1]},
      diameter_(std::min(distance_[0], distance_[2])),
      window_(kSameFoot * std::min(radius_[0], radius_[1])),
      reach_((2.0 + kReachMargin) * std::max(radius_[0], radius_[1])),
      arclength_(rod.arclength()),
      voronoi_(rod.voronoi_length),
      own_rows_(2 * static_cast<std::size_t>(rod.nodes())),
      candidates_(std::make_shared<Candidates>(rod, reach_, margin, least_loop(rod.material.radius))),
      search_(rod.nodes(), reach_),
      catch_up_time_(catch_up) {
  const Eigen::Index nodes = rod.nodes();
  accepted_.begin.assign(2 * static_cast<std::size_t>(nodes) + 1, 0);
  iterate_ = accepted_;
  moved_.resize(static_cast<std::size_t>(nodes));
}

void SmoothContact::halve(const SmoothContact& whole) {
  own_rows_ = static_cast<std::size_t>(whole.arclength_.size());
  candidates_ = whole.candidates_;
  fraction_ = whole.fraction_;
  accepted_ = whole.accepted_;
  first_step_ = whole.first_step_;
}

void SmoothContact::mirror(const SmoothContact& half, const HalfTurn& image) {
  half.remember(nullptr, iterate_);
  const double length = arclength_[arclength_.size() - 1];
  const auto own = static_cast<int>(half.own_rows_);
  for (int row = own; row < 2 * own; ++row) {
    const std::size_t of = at(2 * own - 1 - row);
    iterate_.begin[at(row)] = static_cast<int>(iterate_.entries.size());
    for (int m = iterate_.begin[of + 1]; m-- > iterate_.begin[of];) {
      Memory memory = iterate_.entries[at(m)];
      memory.arclength_b = length - memory.arclength_b;
      memory.friction.slip = image.turn * memory.friction.slip;
      memory.friction.rolled *= -1.0;
      memory.z = image.turn * memory.z;
      memory.zeta *= -1.0;
      iterate_.entries.push_back(memory);
    }
  }
  iterate_.begin[at(2 * own)] = static_cast<int>(iterate_.entries.size());
  mirror_feet(half, image);
}

/// The feet of a half are those of its last evaluation, and as exact as they were found.
void SmoothContact::mirror_feet(const SmoothContact& half, const HalfTurn& image) {
  const std::vector<int>& segments = candidates_->segments();
  const int last = 2 * static_cast<int>(segments.size()) - 1;
  std::vector<FootSearch::Foot>& feet = search_.feet();
  feet.clear();
  for (const FootSearch::Foot& foot : half.search_.feet())
    if (half.row_of(foot.point) < half.own_rows_) feet.push_back(foot);
  for (std::size_t i = feet.size(); i-- > 0;) {
    FootSearch::Foot foot = feet[i];
    if (segments[at((last - foot.point) / 2)] != image.image(segment_of(foot.point))) return;
    const double distance = foot.x[3];
    foot = {image * foot.x, 1.0 - foot.u, last - foot.point, image.image(foot.segment)};
    foot.x[3] = distance;
    feet.push_back(foot);
  }
  has_feet_ = true;
}

void SmoothContact::begin(const Points& start) {
  candidates_->refresh(start);
  iterate_ = accepted_;
  for (Memory& memory : iterate_.entries) memory.pressed = memory.pressure > 0.0;
  first_evaluation_ = true;
  searched_.clear();
}

void SmoothContact::evaluate(const Points& position, const Points& start, double dt) {
  if (!first_evaluation_) remember(nullptr, iterate_);
  first_evaluation_ = false;
  contacts_.clear();
  surfaces_.clear();
  soft_.clear();
  tracked_.clear();
  recalled_.assign(iterate_.entries.size(), 0);
  dt_ = dt;
  catch_up_ = dt / (dt + catch_up_time_);
  const std::vector<int>& segments = candidates_->segments();
  if (segments.empty()) return;
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    const auto node = static_cast<Eigen::Index>(i);
    moved_[i] = to_lanes(position.col(node).data()) - to_lanes(start.col(node).data());
  }
  if (fraction_.size() == 0) set_fractions(start);
  find_feet(position, segments);
  for (std::size_t i = 0; i < search_.feet().size();) i = follow(i);
  for (Tracked& foot : tracked_) {
    if (soft()) set_soft(foot);
    if (foot.memory.weighting < 0.0) {
      foot.memory.weighting = std::min(weighting(search_.feet()[foot.foot], position), largest_weighting(foot.memory));
      foot.memory.offset = offset_at(search_.feet()[foot.foot], position);
      const double deepest = (soft() ? kDeepestSoft : kDeepest) * 0.5 * distance_[foot.pair];
      foot.memory.inside = !first_step_ && overlap(foot) > deepest && began_inside(foot);
      if (turns_ && !first_step_ && overlap(foot) > 0.0) foot.memory.weighting = 0.0;  // smooth_contact.hpp
    }
    if (takes_part(foot)) add_contact(foot);
  }
  if (turns_) add_shifts(contacts_, surfaces_);
  evaluate_forces(laws_, dt, contacts_);
  if (turns_) set_couples(rolling_, contacts_, surfaces_);
  if (soft()) add_thinning(laws_, contacts_, surfaces_, soft_);
}

bool SmoothContact::near_last_search() const {
  if (!turns_ || searched_.empty()) return false;
  const double far2 = kFarSinceSearch * kFarSinceSearch * 0.25 * diameter_ * diameter_;
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    const Lanes apart = moved_[i] - searched_[i];
    if (dot(apart, apart) > far2) return false;
  }
  return true;
}

void SmoothContact::find_feet(const Points& position, const std::vector<int>& segments) {
  if ((has_feet_ || near_last_search()) && follow_feet(position, segments)) return;
  searched_ = moved_;
  search_.begin(position, segments);
  for (const int segment : segments) {
    if (2 * at(segment) >= own_rows_) break;
    const PointsOfSegment points = points_of(segment);
    search_.look(points[0], points[1], candidates_->begin(segment), candidates_->end(segment));
  }
  search_.find();
}

bool SmoothContact::follow_feet(const Points& position, const std::vector<int>& segments) {
  search_.begin_to_follow(position, segments);
  for (const int segment : segments) {
    if (2 * at(segment) >= own_rows_) break;
    const PointsOfSegment points = points_of(segment);
    search_.add(points[0], points[1]);
  }
  return std::exchange(has_feet_, false) || search_.follow();
}

SmoothContact::PointsOfSegment SmoothContact::points_of(int segment) const {
  const SegmentParabola& c = search_.parabola(segment);
  const Lanes shift = fraction_[segment] * c.k;
  const auto point = [&](double u) { return c.m + u * c.t + (0.5 * u * u) * c.k - shift; };
  return {point(kIntegrationPoints[0]), point(kIntegrationPoints[1])};
}

std::size_t SmoothContact::follow(std::size_t foot) {
  const std::vector<FootSearch::Foot>& feet = search_.feet();
  const int point = feet[foot].point;
  const double arclength_a = arclength_at(arclength_, segment_of(point), kIntegrationPoints[point % 2]);
  const double exclusion = candidates_->exclusion(segment_of(point));
  const int mine = is_other(segment_of(point));
  const std::size_t first = tracked_.size();
  for (; foot < feet.size() && feet[foot].point == point; ++foot) {
    if (row_of(point) >= own_rows_) continue;
    const double arclength_b = arclength_at(arclength_, feet[foot].segment, feet[foot].u);
    if (std::abs(arclength_a - arclength_b) < exclusion) continue;
    Tracked& tracked = tracked_.emplace_back();
    tracked.memory.arclength_b = arclength_b;
    tracked.foot = foot;
    tracked.pair = mine + is_other(feet[foot].segment);
  }
  recall(row_of(point), first);
  return foot;
}

void SmoothContact::recall(std::size_t row, std::size_t first) {
  const int begin = iterate_.begin[row], end = iterate_.begin[row + 1];
  // Nearest pairs first, each memory to one foot only: of two feet of a point one may be new.
  for (int pass = begin; pass < end; ++pass) {
    double nearest = window_;
    const Memory* memory = nullptr;
    Memory* own = nullptr;
    for (int m = begin; m < end; ++m) {
      const Memory& candidate = iterate_.entries[static_cast<std::size_t>(m)];
      if (recalled_[static_cast<std::size_t>(m)]) continue;
      for (std::size_t i = first; i < tracked_.size(); ++i) {
        const double away = std::abs(candidate.arclength_b - tracked_[i].memory.arclength_b);
        if (tracked_[i].memory.weighting >= 0.0 || away >= nearest) continue;
        nearest = away;
        memory = &candidate;
        own = &tracked_[i].memory;
      }
    }
    if (!own) break;
    recalled_[static_cast<std::size_t>(memory - iterate_.entries.data())] = 1;
    const double here = own->arclength_b;
    *own = *memory;
    own->arclength_b = here;
  }
}

double SmoothContact::overlap(const Tracked& foot) const {
  const double distance = search_.feet()[foot.foot].x[3], offset = foot.memory.offset;
  if (soft()) return foot.soft.sum - foot.soft.scale * (distance - offset);
  return distance_[foot.pair] - distance + offset;
}

double SmoothContact::stretch(int segment, double u) const {
  const SegmentParabola& c = search_.parabola(segment);
  const Lanes along = c.t + u * c.k;
  return std::sqrt(dot(along, along)) / ((1.0 - u) * (*rest_length_)[segment - 1] + u * (*rest_length_)[segment]);
}

void SmoothContact::set_soft(Tracked& tracked) const {
  const FootSearch::Foot& foot = search_.feet()[tracked.foot];
  const int segment = segment_of(foot.point);
  tracked.soft = SoftPoint::of(radius_[is_other(segment)], stretch(segment, kIntegrationPoints[foot.point % 2]),
                               radius_[is_other(foot.segment)], stretch(foot.segment, foot.u));
  const double before = (*rest_length_)[foot.segment - 1], grows = (*rest_length_)[foot.segment] - before;
  tracked.soft.rest_growth = grows / (before + foot.u * grows);
}

bool SmoothContact::began_inside(const Tracked& tracked) const {
  const FootSearch::Foot& foot = search_.feet()[tracked.foot];
  const int segment = segment_of(foot.point);
  const PointWeights wa(kIntegrationPoints[foot.point % 2], fraction_[segment]);
  const SegmentWeights wb(foot.u);
  Lanes x = foot.x;
  for (int k = 0; k < 3; ++k) {
    x -= wa.value[k] * moved_[static_cast<std::size_t>(segment - 1 + k)];
    x += wb.value[k] * moved_[static_cast<std::size_t>(foot.segment - 1 + k)];
  }
  const double touching = soft() ? tracked.soft.radii() : distance_[tracked.pair];
  return to_vec3(x).norm() < touching + tracked.memory.offset;
}

bool SmoothContact::takes_part(const Tracked& foot) const {
  if (foot.memory.inside) return false;
  return foot.memory.pressed || foot.memory.pressure > 0.0 || overlap(foot) > 2.0 * laws_[foot.pair].normal.begin();
}

void SmoothContact::add_contact(Tracked& tracked) {
  const FootSearch::Foot& foot = search_.feet()[tracked.foot];
  const int segment = segment_of(foot.point);
  const double u = foot.u, u_a = kIntegrationPoints[foot.point % 2];
  tracked.contact = contacts_.size();
  ContactPoint& contact = contacts_.emplace_back();
  contact.point = foot.point % 2;
  contact.a0 = segment - 1;
  contact.b0 = foot.segment - 1;
  const PointWeights wa(u_a, fraction_[segment]);
  const SegmentWeights wb(u);
  for (int k = 0; k < 3; ++k) {
    contact.c[k] = wa.value[k];
    contact.c[3 + k] = -wb.value[k];
    contact.beta[3 + k] = wb.derivative[k];
  }
  contact.arclength_a = arclength_at(arclength_, segment, u_a);
  contact.arclength_b = tracked.memory.arclength_b;
  contact.d = foot.x[3];
  contact.x = to_vec3(foot.x);
  contact.n = to_vec3((1.0 / contact.d) * foot.x);
  contact.overlap = overlap(tracked);
  contact.pair = tracked.pair;
  contact.begins = laws_[contact.pair].normal.begin();
  contact.weighting = tracked.memory.weighting;
  contact.weight = 0.5 * voronoi_[segment] * contact.weighting;
  if (soft()) {
    soft_.push_back(tracked.soft);
    contact.weight *= stretch(segment, u_a) / tracked.soft.scale;
  }
  contact.prediction = tracked.memory.pressure;
  contact.memory = tracked.memory.friction;
  contact.z_old = tracked.memory.z;
  contact.zeta_old = tracked.memory.zeta;
  const SegmentParabola& c = search_.parabola(foot.segment);
  const Lanes db = c.t + u * c.k;
  contact.db = to_vec3(db);
  const double length2 = dot(db, db);
  // At a minimum G >= 0; it vanishes where the foot is about to jump, and omega follows it there within 0.05 s.
  const double least = turns_ ? kLeastG : kLeastGOnCentrelines;
  contact.inverse_g = 1.0 / std::max(length2 - dot(foot.x, c.k), least * length2);
  if (contact.active() && (laws_[contact.pair].friction.on() || soft())) set_slip(contact);
  if (turns_) add_surface(contact, search_.parabola(segment), c, u);
}

void SmoothContact::add_surface(const ContactPoint& contact, const SegmentParabola& a, const SegmentParabola& b,
                                double u_b) {
  SurfacePoint& surface = surfaces_.emplace_back();
  if (!contact.active() || !(laws_[contact.pair].friction.on() || soft())) return;
  const double u_a = kIntegrationPoints[contact.point];
  const SegmentWeights weights(u_a);
  const auto moved = [&](int node) -> const Lanes& { return moved_[static_cast<std::size_t>(node)]; };
  const auto length = [&](int edge) { return turns_->length[static_cast<std::size_t>(edge)]; };
  const auto turned = [&](int edge) { return turns_->turn[static_cast<std::size_t>(edge)]; };
  Lanes turn = {};
  for (int k = 0; k < 3; ++k) {
    surface.d_a[k] = weights.derivative[k];
    turn += weights.derivative[k] * moved(contact.a0 + k);
  }
  surface.along_a = to_vec3(a.t + u_a * a.k);
  surface.turn_a = to_vec3(turn);
  surface.bend_b = to_vec3(b.k);
  surface.bend_turn_b = to_vec3(moved(contact.b0) - 2.0 * moved(contact.b0 + 1) + moved(contact.b0 + 2));
  for (int j = 0; j < 2; ++j) {
    const int on_a = contact.a0 + j, on_b = contact.b0 + j;
    surface.s_a[j] = (j == 0 ? 1.0 - u_a : u_a) * length(on_a);
    surface.s_b[j] = (j == 0 ? 1.0 - u_b : u_b) * length(on_b);
    surface.s_slope_b[j] = (j == 0 ? -1.0 : 1.0) * length(on_b);
    surface.spin_a += surface.s_a[j] * turned(on_a);
    surface.spin_b += surface.s_b[j] * turned(on_b);
    surface.spin_slope_b += surface.s_slope_b[j] * turned(on_b);
  }
  surface.lever = 0.5 * couple_;
  if (contact.pair != 1) return;
  const int mine = is_other(contact.a0 + 1);
  surface.lever = couple_ * (radius_[mine] / distance_[1]);
  surface.uneven = radius_[1 - mine] / radius_[mine];
}

void SmoothContact::set_slip(ContactPoint& contact) const {
  Lanes slip = to_lanes(contact.memory.slip), turn = {};
  const Lanes *a = &moved_[static_cast<std::size_t>(contact.a0)], *b = &moved_[static_cast<std::size_t>(contact.b0)];
  for (int k = 0; k < 3; ++k) {
    slip += contact.c[k] * a[k];
    slip += contact.c[3 + k] * b[k];
    turn += contact.beta[3 + k] * b[k];
  }
  contact.slip = to_vec3(slip);
  contact.turn = to_vec3(turn);
}

ContactMotion SmoothContact::motion(const ContactPoint& contact, const Points& position, const Points& start) const {
  ContactMotion out;
  Vec3 turn = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    out.slip += contact.c[k] * (position.col(contact.a0 + k) - start.col(contact.a0 + k));
    const Vec3 moved = position.col(contact.b0 + k) - start.col(contact.b0 + k);
    out.slip += contact.c[3 + k] * moved;
    turn += contact.beta[3 + k] * moved;
  }
  if (turns_) {
    const SurfacePoint& surface = surfaces_[static_cast<std::size_t>(&contact - contacts_.data())];
    out.rolling = rolling(contact, surface);
    out.passed_on = (1.0 + surface.uneven) * surface.lever;
  }
  // From today's foot, which was near the nearest place then.
  const Vec3 x = contact.x - out.slip;
  const double uphill = x.dot(contact.db - turn);
  const double d2 = x.squaredNorm() - uphill * uphill * contact.inverse_g;
  const double before = std::sqrt(std::max(d2, 0.0));
  out.overlap_before = contact.overlap + contact.d - before;
  out.weight = out.weight_before = contact.weight;
  if (soft()) {
    const auto number = static_cast<std::size_t>(&contact - contacts_.data());
    add_thinning(contact, surfaces_[number], soft_[number], before, out);
  }
  return out;
}

double SmoothContact::weighting(const FootSearch::Foot& foot, const Points& position) const {
  const int segment = segment_of(foot.point);
  const double ua = kIntegrationPoints[foot.point % 2];
  const Vec3 x = to_vec3(foot.x);
  const Vec3 da = combine(SegmentWeights(ua).derivative, position, segment);
  const Vec3 db = combine(SegmentWeights(foot.u).derivative, position, foot.segment);
  const double g_b = least_curvature_factor(position, foot.segment, foot.u, x, db.squaredNorm());
  const double g_a = least_curvature_factor(position, segment, ua, -x, da.squaredNorm());
  const double a4 = g_a * g_a * g_a * g_a, b4 = g_b * g_b * g_b * g_b;
  // Where each strand stands in the other's centre of curvature neither side has a foot that means anything.
  constexpr double kBlind = 1e-4;
  return b4 / (a4 + b4 + kBlind);
}

double SmoothContact::largest_weighting(const Memory& memory) const {
  const Eigen::Index last = arclength_.size() - 1;
  const double begin = 0.5 * (arclength_[0] + arclength_[1]), end = 0.5 * (arclength_[last - 1] + arclength_[last]);
  const double left = std::min(memory.arclength_b - begin, end - memory.arclength_b);
  return std::clamp(left / (kFading * 0.5 * diameter_), 0.0, 1.0);
}

double SmoothContact::offset_at(const FootSearch::Foot& foot, const Points& position) const {
  const int last = static_cast<int>(position.cols()) - 2;
  const int other = foot.u < 0.5 ? std::max(foot.segment - 1, 1) : std::min(foot.segment + 1, last);
  const double away = std::abs(foot.u - 0.5);
  const Vec3 moved = (1.0 - away) * fraction_[foot.segment] * second_difference(position, foot.segment) +
                     away * fraction_[other] * second_difference(position, other);
  return -to_vec3(foot.x).dot(moved) / foot.x[3];
}

void SmoothContact::remember(const Points* accepted, MemoryList& list) const {
  list.entries.clear();
  std::size_t done = 0;
  for (const Tracked& tracked : tracked_) {
    const FootSearch::Foot& foot = search_.feet()[tracked.foot];
    while (done <= row_of(foot.point)) list.begin[done++] = static_cast<int>(list.entries.size());
    Memory& memory = list.entries.emplace_back(tracked.memory);
    const ContactPoint* contact = tracked.contact == kNone ? nullptr : &contacts_[tracked.contact];
    if (!accepted) {
      if (contact) memory.pressure = contact->prediction;
      memory.z = contact ? contact->z : Vec3::Zero();
      memory.zeta = contact && turns_ ? surfaces_[tracked.contact].zeta : 0.0;
      continue;
    }
    memory.inside = memory.inside && overlap(tracked) > 0.0;
    memory.weighting += catch_up_ * (weighting(foot, *accepted) - memory.weighting);
    memory.weighting = std::min(memory.weighting, largest_weighting(memory));
    memory.offset += catch_up_ * (offset_at(foot, *accepted) - memory.offset);
    memory.pressure = contact ? contact->pressure : 0.0;
    memory.z.setZero();
    memory.zeta = 0.0;
    memory.friction = contact ? remembered(*contact) : FrictionMemory();
  }
  while (done < list.begin.size()) list.begin[done++] = static_cast<int>(list.entries.size());
}

FrictionMemory SmoothContact::remembered(const ContactPoint& contact) const {
  const Friction& friction = laws_[contact.pair].friction;
  if (!rolling_.on()) return knot_utm::remember(friction, contact, dt_);
  const auto number = static_cast<std::size_t>(&contact - contacts_.data());
  return knot_utm::remember(friction, rolling_, contact, surfaces_[number], dt_);
}

void SmoothContact::set_fractions(const Points& position) {
  fraction_.setZero(position.cols());
  for (int i = 1; i + 1 < static_cast<int>(position.cols()); ++i) {
    const double turn2 = second_difference(position, i).squaredNorm() / (voronoi_[i] * voronoi_[i]);
    const double left = std::max(0.0, 1.0 - turn2 / (kSharpest * kSharpest));
    fraction_[i] = PointWeights::kWhole * left * left;
  }
}

void SmoothContact::commit(const Points& position) {
  set_fractions(position);
  remember(&position, accepted_);
  first_step_ = false;
}

void SmoothContact::Memory::state(Archive& archive) {
  archive(arclength_b, weighting, offset, pressure, friction, inside);
}

void SmoothContact::MemoryList::state(Archive& archive) {
  archive.list(entries);
  archive(begin);
  const bool rows = begin.front() == 0 && begin.back() == static_cast<int>(entries.size()) &&
                    std::is_sorted(begin.begin(), begin.end());
  archive.require(rows, "rows of contacts", std::to_string(entries.size()) + " entries");
}

void SmoothContact::state(Archive& archive) {
  archive.section("SMTJ");  // "SMTI" had no number that a friction law keeps
  archive.list(fraction_);
  const bool of_this_rod = fraction_.size() == 0 || fraction_.size() == arclength_.size();
  archive.require(of_this_rod, "fractions of points outwards", "of " + std::to_string(fraction_.size()) + " nodes");
  archive(*candidates_, accepted_, first_step_);
  if (!rolling_.on()) return;
  archive.section("ROL2");  // before there was none, and a vector for each
  for (Memory& memory : accepted_.entries) archive(memory.friction.rolled);
}

}  // namespace knot_utm
