#include "knot_utm/contact/contact_point.hpp"

#include <type_traits>

#include "four_contacts.hpp"

namespace knot_utm {
namespace {

template <typename Law>
void evaluate_forces(const Law& law, double dt, const std::array<ContactPoint*, 4>& contacts) {
  const Four<ContactPoint> four(contacts);
  const FourVectors n = four(&ContactPoint::n);
  FourVectors z = {}, force = n;
  Lanes mu = {};
  if (law.coefficient > 0.0) {
    const FourVectors slip = four(&ContactPoint::slip);
    const FrictionTraction<FourVectors> t =
        law.traction(friction_input(contacts, four(&ContactPoint::pressure), slip - dot(n, slip) * n, dt));
    z = t.z;
    mu = t.coefficient;
    force -= mu * z;
  }
  const Parted forces(four(&ContactPoint::weight) * four(&ContactPoint::pressure) * force), directions(z);
  for (std::size_t i = 0; i < 4; ++i) {
    contacts[i]->z = to_vec3(directions[i]);
    contacts[i]->mu = mu[static_cast<int>(i)];
    contacts[i]->force = to_vec3(forces[i]);
  }
}

void set_pressures(const NormalLaw& normal, const std::array<ContactPoint*, 4>& contacts) {
  const Lanes pressure = normal.pressure(Four<ContactPoint>(contacts)(&ContactPoint::overlap));
  for (std::size_t i = 0; i < 4; ++i) contacts[i]->pressure = pressure[static_cast<int>(i)];
}

/// What a roller's turn adds to the models of four contacts on it. It takes the surface along by psi a x X, with a its
/// axis and X the gap, so that r changes by -a x X as psi does and by -psi a x S as the rod does.
template <typename Tangent>
void add_turn(const Four<const ContactPoint>& four, const Tangent& friction, const Lanes& stiffness,
              RollerModel* models) {
  const FourVectors n = four(&ContactPoint::n), axis = four(&ContactPoint::axis);
  const Lanes zero = {}, turned = four(&ContactPoint::turned);
  const auto slipped = [&](const FourVectors& surface) {
    return stiffness * friction.slope_times(surface - dot(n, surface) * n);
  };
  const Parted by_turn(-1.0 * slipped(cross(axis, four(&ContactPoint::x))));
  const FourVectors sweep = turned * axis;
  const Parted still[3] = {Parted(slipped({zero, sweep.z, -1.0 * sweep.y})),
                           Parted(slipped({-1.0 * sweep.z, zero, sweep.x})),
                           Parted(slipped({sweep.y, -1.0 * sweep.x, zero}))};
  for (std::size_t i = 0; i < 4; ++i) {
    models[i].by_turn = by_turn[i];
    for (std::size_t j = 0; j < 3; ++j) models[i].still[j] -= still[j][i];
  }
}

template <typename Pressure, typename Law, typename Model>
void linearise(const Pressure& normal, const Law& law, double dt, const ContactLinearisation& how,
               const std::array<const ContactPoint*, 4>& contacts, Model* models) {
  const Four<const ContactPoint> four(contacts);
  const FourPressures law_of_pressure(normal, how, four);
  const Lanes &slope = law_of_pressure.slope, &pressure = law_of_pressure.pressure, &turning = law_of_pressure.turning;
  const Lanes weight = four(&ContactPoint::weight), over_d = 1.0 / four(&ContactPoint::d), p = weight * turning;

  const FourVectors n = four(&ContactPoint::n), db = four(&ContactPoint::db), axis = four(&ContactPoint::axis);
  const FourVectors n_u = -over_d * db;  // dn/du
  // With N = dn/dS = (P - axis axis^T)/d, P = 1 - n n^T (a roller's gap has no part along its axis), and dp/dS = -p' n,
  //   dg/dS = p N - p' (n + dt/dp) n^T - s C Y,   s = p stiffness,   p that turns,
  //   Y = d(P r)/dS = P - (n.r) N - n (N r)^T.
  // with C the law's own (FrictionTangent). z, left and right being tangential, C P = across P + along left right^T and
  // C n = across n: all of it is multiples of the identity, left right^T and columns times n^T, axis^T and (N r)^T.
  Lanes on_identity = p * over_d, on_left = {}, on_pulled = {};
  FourVectors axis_column = -on_identity * axis;
  FourVectors direction = n, pressing = n;  // n - mu z and n + dt/dp
  FourVectors left = {}, right = {}, pulled = {}, slide = p * n_u;
  FrictionTangent<FourVectors> t;
  Lanes s;
  if (law.coefficient > 0.0) {
    const FourVectors r = four(&ContactPoint::slip), turn = four(&ContactPoint::turn);
    const Lanes away = dot(n, r), unturned = 1.0 - away * over_d;
    const FourVectors tangential = r - away * n;
    t = law.tangent(friction_input(contacts, turning, tangential, dt), how.friction);
    left = t.left;
    right = t.right;
    s = t.stiffness * p;
    const Lanes across = s * t.across, along = s * t.along;
    direction -= t.coefficient * t.z;
    pressing -= t.by_pressure;
    on_identity -= across * unturned;
    on_left = -along * unturned;
    on_pulled = across * over_d;
    axis_column -= (away * over_d * s) * t.slope_times(axis);
    pulled = tangential - dot(axis, r) * axis;
    slide += s * t.slope_times(turn - dot(n, turn) * n + away * n_u + dot(r, n_u) * n);
  }
  const Parted forces(weight * pressure * direction), slides(slide);
  pressing = weight * slope * pressing;

  const auto column = [&](const Lanes& n_j, const Lanes& right_j, const Lanes& pulled_j, const Lanes& axis_j) {
    return n_j * pressing - (on_pulled * pulled_j - on_identity * n_j) * n - (on_left * right_j) * left -
           axis_j * axis_column;
  };
  FourVectors still[3] = {column(n.x, right.x, pulled.x, axis.x), column(n.y, right.y, pulled.y, axis.y),
                          column(n.z, right.z, pulled.z, axis.z)};
  still[0].x -= on_identity;
  still[1].y -= on_identity;
  still[2].z -= on_identity;
  const Parted columns[3] = {Parted(still[0]), Parted(still[1]), Parted(still[2])};
  for (std::size_t i = 0; i < 4; ++i) {
    Model& model = models[i];
    model.pressure = pressure[static_cast<int>(i)];
    model.slope = slope[static_cast<int>(i)];
    model.force = forces[i];
    model.slide = slides[i];
    for (std::size_t j = 0; j < 3; ++j) model.still[j] = columns[j][i];
  }
  if constexpr (std::is_same_v<Model, RollerModel>)
    if (law.coefficient > 0.0) add_turn(four, t, s, models);
}

/// Calls use(law) with the friction law of each pair, whose type is chosen once for all contacts.
template <typename Contacts, typename Use>
void visit_active(const ContactLaws& laws, Contacts& contacts, const Use& use) {
  laws[0].friction.visit([&](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    visit_active(contacts, [&](const auto& four, std::size_t first) {
      const PairLaws& of = laws[four[0]->pair];
      use(of.normal, of.friction.template as<Law>(), four, first);
    });
  });
}

template <typename Model>
void linearise_all(const ContactLaws& laws, double dt, const ContactLinearisation& how,
                   const std::vector<ContactPoint>& contacts, std::vector<Model>& models) {
  // Room for the fours that the last one fills up.
  models.resize(contacts.size() + 3);
  visit_active(laws, contacts, [&](const NormalLaw& normal, const auto& law, const auto& four, std::size_t first) {
    linearise(normal, law, dt, how, four, &models[first]);
  });
}

}  // namespace

void evaluate_forces(const ContactLaws& laws, double dt, std::vector<ContactPoint>& contacts) {
  visit_active(laws, contacts, [&](const NormalLaw& normal, const auto& law, const auto& four, std::size_t) {
    set_pressures(normal, four);
    evaluate_forces(law, dt, four);
  });
}

FrictionInput<Vec3> friction_input(const ContactPoint& contact, double dt) {
  return {contact.pressure,    contact.slip - contact.n.dot(contact.slip) * contact.n,
          contact.memory.slip, contact.db,
          contact.memory.own,  dt};
}

FrictionMemory remember(const Friction& friction, const ContactPoint& contact, double dt) {
  if (!friction.on() || !contact.touches()) return {};
  return friction.visit([&](const auto& law) { return law.remember(friction_input(contact, dt), contact.z); });
}

void linearise(const ContactLaws& laws, double dt, const ContactLinearisation& how,
               const std::vector<ContactPoint>& contacts, std::vector<ContactModel>& models) {
  linearise_all(laws, dt, how, contacts, models);
}

void linearise(const ContactLaws& laws, double dt, const ContactLinearisation& how,
               const std::vector<ContactPoint>& contacts, std::vector<RollerModel>& models) {
  linearise_all(laws, dt, how, contacts, models);
}

}  // namespace knot_utm
