#include "knot_utm/contact/contact_point.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "knot_utm/solver/lanes.hpp"

namespace knot_utm {

namespace {

/// Four contacts side by side.
template <typename Contact>
class Four {
 public:
  explicit Four(const std::array<Contact*, 4>& contacts) : contacts_(contacts) {}

  Lanes operator()(double ContactPoint::*number) const {
    return Lanes{contacts_[0]->*number, contacts_[1]->*number, contacts_[2]->*number, contacts_[3]->*number};
  }
  FourVectors operator()(Vec3 ContactPoint::*vector) const {
    return FourVectors::of(to_lanes(contacts_[0]->*vector), to_lanes(contacts_[1]->*vector),
                           to_lanes(contacts_[2]->*vector), to_lanes(contacts_[3]->*vector));
  }

 private:
  std::array<Contact*, 4> contacts_;
};

/// What becomes of four vectors: each is one again.
class Parted {
 public:
  explicit Parted(const FourVectors& v) : vectors_{v.x, v.y, v.z, Lanes{}} {
    transpose(vectors_[0], vectors_[1], vectors_[2], vectors_[3]);
  }
  const Lanes& operator[](std::size_t i) const { return vectors_[i]; }

 private:
  Lanes vectors_[4];
};

void evaluate_forces(const Friction& friction, double friction_scale, const std::array<ContactPoint*, 4>& contacts) {
  const Four<ContactPoint> four(contacts);
  const FourVectors n = four(&ContactPoint::n);
  FourVectors z = {}, force = n;
  if (friction.on()) {
    const FourVectors slip = four(&ContactPoint::slip);
    const FourVectors tangential = slip - dot(n, slip) * n;
    z = friction_direction(friction.law, (1.0 / friction_scale) * tangential);
    force -= friction.coefficient * z;
  }
  const Parted forces(four(&ContactPoint::weight) * four(&ContactPoint::pressure) * force), directions(z);
  for (std::size_t i = 0; i < 4; ++i) {
    contacts[i]->z = to_vec3(directions[i]);
    contacts[i]->force = to_vec3(forces[i]);
  }
}

void set_pressures(const NormalLaw& normal, const std::array<ContactPoint*, 4>& contacts) {
  const Lanes pressure = normal.pressure(Four<ContactPoint>(contacts)(&ContactPoint::overlap));
  for (std::size_t i = 0; i < 4; ++i) contacts[i]->pressure = pressure[static_cast<int>(i)];
}

void linearise(const NormalLaw& normal, const Friction& friction, double friction_scale, bool expects,
               const std::array<const ContactPoint*, 4>& contacts, ContactModel* models) {
  const Four<const ContactPoint> four(contacts);
  const Lanes overlap = four(&ContactPoint::overlap), estimate = four(&ContactPoint::estimate);
  const Lanes weight = four(&ContactPoint::weight), over_d = 1.0 / four(&ContactPoint::d);
  // A contact that is new and deep: the depth where the rod stiffens is a better guess than a wall.
  const Lanes without = select(overlap < normal.stiffening, overlap, constant<Lanes>(normal.stiffening));
  const Lanes tangent_at = select(estimate > 0.0, normal.overlap_at(estimate), without);
  const Lanes slope = normal.slope(tangent_at);
  const Lanes pressure = normal.pressure(tangent_at) + slope * (overlap - tangent_at);
  const Lanes p = weight * (expects ? expected_pressure(estimate, pressure) : pressure);

  const FourVectors n = four(&ContactPoint::n), db = four(&ContactPoint::db), axis = four(&ContactPoint::axis);
  const FourVectors n_u = -over_d * db;  // dn/du
  // With N = dn/dS = (P - axis axis^T)/d, P = 1 - n n^T (a roller's gap has no part along its axis), and dp/dS = -p' n,
  //   dg/dS = p N - p' (n - mu z) n^T - s C Y,   s = mu p/scale,   p that turns,
  //   Y = d(P r)/dS = P - (n.r) N - n (N r)^T.
  // z and u being tangential, C P = across P + along u u^T and C n = across n: all of it is multiples of the identity,
  // u u^T and columns times n^T, axis^T and (N r)^T.
  Lanes on_identity = p * over_d, on_u = {}, on_pulled = {};
  FourVectors axis_column = -on_identity * axis;
  FourVectors pressing = n;  // n - mu z
  FourVectors u = {}, pulled = {}, slide = p * n_u;
  if (friction.on()) {
    const FourVectors r = four(&ContactPoint::slip), turn = four(&ContactPoint::turn);
    const double over_scale = 1.0 / friction_scale;
    const Lanes away = dot(n, r), left = 1.0 - away * over_d;
    const FourVectors tangential = r - away * n;
    const auto direction = linearised_direction(friction.law, friction.secant, over_scale * tangential);
    u = direction.u;
    const Lanes s = (friction.coefficient * over_scale) * p;
    const Lanes across = s * direction.across, along = s * direction.along;
    pressing -= friction.coefficient * direction.z;
    on_identity -= across * left;
    on_u = -along * left;
    on_pulled = across * over_d;
    axis_column -= (away * over_d * s) * direction.slope_times(axis);
    pulled = tangential - dot(axis, r) * axis;
    slide += s * direction.slope_times(turn - dot(n, turn) * n + away * n_u + dot(r, n_u) * n);
  }
  const Parted forces(weight * pressure * pressing), slides(slide);
  pressing = weight * slope * pressing;

  const auto column = [&](const Lanes& n_j, const Lanes& u_j, const Lanes& pulled_j, const Lanes& axis_j) {
    return n_j * pressing - (on_pulled * pulled_j - on_identity * n_j) * n - (on_u * u_j) * u - axis_j * axis_column;
  };
  FourVectors still[3] = {column(n.x, u.x, pulled.x, axis.x), column(n.y, u.y, pulled.y, axis.y),
                          column(n.z, u.z, pulled.z, axis.z)};
  still[0].x -= on_identity;
  still[1].y -= on_identity;
  still[2].z -= on_identity;
  const Parted columns[3] = {Parted(still[0]), Parted(still[1]), Parted(still[2])};
  for (std::size_t i = 0; i < 4; ++i) {
    ContactModel& model = models[i];
    model.pressure = pressure[static_cast<int>(i)];
    model.slope = slope[static_cast<int>(i)];
    model.force = forces[i];
    model.slide = slides[i];
    for (std::size_t j = 0; j < 3; ++j) model.still[j] = columns[j][i];
  }
}

/// Calls visit(four, first) for the active contacts in order, four at a time, `first` being the number of the first of
/// them; the last one fills up what is left.
template <typename Contacts, typename Visit>
void visit_active(Contacts& contacts, Visit visit) {
  std::array<decltype(contacts.data()), 4> four;
  std::size_t first = 0, count = 0;
  for (auto& contact : contacts) {
    if (!contact.active()) continue;
    four[count++] = &contact;
    if (count < 4) continue;
    visit(four, first);
    first += count;
    count = 0;
  }
  if (count == 0) return;
  std::fill(four.begin() + static_cast<std::ptrdiff_t>(count), four.end(), four[count - 1]);
  visit(four, first);
}

}  // namespace

void evaluate_forces(const Friction& friction, double friction_scale, std::vector<ContactPoint>& contacts) {
  visit_active(contacts, [&](const std::array<ContactPoint*, 4>& four, std::size_t) {
    evaluate_forces(friction, friction_scale, four);
  });
}

void evaluate_forces(const NormalLaw& normal, const Friction& friction, double friction_scale,
                     std::vector<ContactPoint>& contacts) {
  visit_active(contacts, [&](const std::array<ContactPoint*, 4>& four, std::size_t) {
    set_pressures(normal, four);
    evaluate_forces(friction, friction_scale, four);
  });
}

void linearise(const NormalLaw& normal, const Friction& friction, double friction_scale, bool expects,
               const std::vector<ContactPoint>& contacts, std::vector<ContactModel>& models) {
  // Room for the fours that the last one fills up.
  models.resize(contacts.size() + 3);
  visit_active(contacts, [&](const std::array<const ContactPoint*, 4>& four, std::size_t first) {
    linearise(normal, friction, friction_scale, expects, four, &models[first]);
  });
}

}  // namespace knot_utm
