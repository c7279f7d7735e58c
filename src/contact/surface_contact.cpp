#include "knot_utm/contact/surface_contact.hpp"

#include <Eigen/Geometry>

#include "four_contacts.hpp"
#include "knot_utm/contact/edge_contact.hpp"

namespace knot_utm {

namespace {

/// phi of one section; on a roller there is no second one.
Vec3 rotation(const Vec3& along, const Vec3& turn, double spin) {
  const double length2 = along.squaredNorm();
  if (length2 == 0.0) return Vec3::Zero();
  return (along.cross(turn) + spin * along) / length2;
}

/// Share of the rotation by which friction's memory turns about n: both sections carry it, or the one on a roller.
double carried(const ContactPoint& contact) { return contact.on_roller() ? 1.0 : 0.5; }

using Points4 = std::array<const SurfacePoint*, 4>;

Lanes four(const Points4& surfaces, double SurfacePoint::*number) {
  return Lanes{surfaces[0]->*number, surfaces[1]->*number, surfaces[2]->*number, surfaces[3]->*number};
}
FourVectors four(const Points4& surfaces, Vec3 SurfacePoint::*vector) {
  return FourVectors::of(to_lanes(surfaces[0]->*vector), to_lanes(surfaces[1]->*vector), to_lanes(surfaces[2]->*vector),
                         to_lanes(surfaces[3]->*vector));
}

/// The sections of four strands.
struct Section {
  FourVectors over;  // c^
  Lanes over_length2;
  FourVectors turn;
  Lanes spin;

  Section(const FourVectors& along, const FourVectors& turn_, const Lanes& spin_) : turn(turn_), spin(spin_) {
    const Lanes length2 = dot(along, along), none = Lanes{};
    over_length2 = select(length2 > 0.0, 1.0 / length2, none);
    over = over_length2 * along;
  }

  FourVectors rotation() const { return cross(over, turn) + spin * over; }

  /// As c', V and Psi change.
  struct Change {
    FourVectors over, rotation;
  };
  Change change(const FourVectors& longer, const FourVectors& turned, const Lanes& spun) const {
    Change out;
    out.over = over_length2 * longer - (2.0 * dot(over, longer)) * over;
    out.rotation = cross(out.over, turn) + cross(over, turned) + spun * over + spin * out.over;
    return out;
  }
};

/// What Newton's method changes, of four contacts.
struct Change {
  FourVectors shift = {}, turn_a = {}, turn_b = {};
  Lanes spin_a = {}, spin_b = {}, turned = {};

  /// One of the numbers that SurfaceModel counts, by 1.
  static Change unit(int number) {
    Change out;
    const Lanes one = constant<Lanes>(1.0);
    const auto component = [&](FourVectors& v, int i) { (i == 0 ? v.x : i == 1 ? v.y : v.z) = one; };
    if (number < SurfaceModel::kTurnA)
      component(out.shift, number);
    else if (number < SurfaceModel::kTurnB)
      component(out.turn_a, number - SurfaceModel::kTurnA);
    else if (number < SurfaceModel::kSpinA)
      component(out.turn_b, number - SurfaceModel::kTurnB);
    else
      (number == SurfaceModel::kSpinA ? out.spin_a : number == SurfaceModel::kSpinB ? out.spin_b : out.turned) = one;
    return out;
  }
};

/// The foot of a smooth strand, or none, on a roller: du = (b'.S + x.V_b)/G.
struct OneFoot {
  static constexpr bool kTwo = false;
  Lanes inverse_g;

  void find(const Change& change, const FourVectors&, const FourVectors& db, const FourVectors& x, Lanes& a,
            Lanes& b) const {
    a = Lanes{};
    b = inverse_g * (dot(db, change.shift) + dot(x, change.turn_b));
  }
};

/// The feet of two edges: H (dt, du) = (-a'.S - x.V_a, b'.S + x.V_b).
struct TwoFeet {
  static constexpr bool kTwo = true;
  Lanes tt, tu, uu;

  void find(const Change& change, const FourVectors& da, const FourVectors& db, const FourVectors& x, Lanes& a,
            Lanes& b) const {
    const Lanes of_a = -1.0 * (dot(da, change.shift) + dot(x, change.turn_a));
    const Lanes of_b = dot(db, change.shift) + dot(x, change.turn_b);
    a = tt * of_a + tu * of_b;
    b = tu * of_a + uu * of_b;
  }
};

/// Four contacts at the point at which they are linearised; symbols as in SurfacePoint and ContactPoint.
template <typename Law, typename Feet>
class FourSurfaces {
 public:
  FourSurfaces(const FourPressures& pressures, const Law& law, double dt, const ContactLinearisation& how,
               const std::array<const ContactPoint*, 4>& contacts, const Points4& surfaces, const Feet& feet)
      : on_roller_(contacts[0]->on_roller()),
        pressures_(pressures),
        feet_(feet),
        a_(four(surfaces, &SurfacePoint::along_a), four(surfaces, &SurfacePoint::turn_a),
           four(surfaces, &SurfacePoint::spin_a)),
        b_(Four<const ContactPoint>(contacts)(&ContactPoint::db),
           Four<const ContactPoint>(contacts)(&ContactPoint::turn), four(surfaces, &SurfacePoint::spin_b)),
        bend_b_(four(surfaces, &SurfacePoint::bend_b)),
        bend_turn_b_(four(surfaces, &SurfacePoint::bend_turn_b)),
        spin_slope_b_(four(surfaces, &SurfacePoint::spin_slope_b)),
        lever_(four(surfaces, &SurfacePoint::lever)) {
    const Four<const ContactPoint> of(contacts);
    x_ = of(&ContactPoint::x);
    n_ = of(&ContactPoint::n);
    db_ = of(&ContactPoint::db);
    axis_ = of(&ContactPoint::axis);
    r_ = of(&ContactPoint::slip);
    over_d_ = 1.0 / of(&ContactPoint::d);
    da_ = four(surfaces, &SurfacePoint::along_a);
    turned_ = of(&ContactPoint::turned);
    remembered_ = FourVectors::of(to_lanes(contacts[0]->memory.slip), to_lanes(contacts[1]->memory.slip),
                                  to_lanes(contacts[2]->memory.slip), to_lanes(contacts[3]->memory.slip));
    rotation_ = a_.rotation() + b_.rotation();
    carried_ = carried(*contacts[0]);
    alpha_ = carried_ * dot(n_, rotation_);
    away_ = dot(n_, r_);
    const FourVectors tangential = r_ - away_ * n_;
    friction_ = law.tangent(friction_input(contacts, pressures_.turning, tangential, dt), how.friction);
    const Lanes weight = of(&ContactPoint::weight);
    turning_ = weight * pressures_.turning;
    stiffness_ = turning_ * friction_.stiffness;
    pressing_ = weight * pressures_.slope * (n_ - friction_.by_pressure);
    force_ = weight * pressures_.pressure * (n_ - friction_.coefficient * friction_.z);
    m_ = cross(lever_ * x_, force_);
  }

  void model(SurfaceModel* models) const {
    const Parted forces(force_), on_a(cross(a_.over, m_), -1.0 * dot(a_.over, m_)),
        on_b(cross(b_.over, m_), -1.0 * dot(b_.over, m_));
    for (std::size_t i = 0; i < 4; ++i) {
      models[i].pressure = pressures_.pressure[static_cast<int>(i)];
      models[i].slope = pressures_.slope[static_cast<int>(i)];
      models[i].force = forces[i];
      models[i].on_a = on_a[i];
      models[i].on_b = on_b[i];
      models[i].two_feet = Feet::kTwo;
    }
    for (int number = 0; number < SurfaceModel::kChanges; ++number) {
      const bool of_b =
          (number >= SurfaceModel::kTurnB && number < SurfaceModel::kSpinA) || number == SurfaceModel::kSpinB;
      if (on_roller_ ? of_b : number == SurfaceModel::kTurned) continue;
      respond(Change::unit(number), number, models);
    }
  }

 private:
  void respond(const Change& change, int number, SurfaceModel* models) const {
    // The feet's ways, and what changes with them.
    Lanes foot_a, foot;
    feet_.find(change, da_, db_, x_, foot_a, foot);
    FourVectors dx = change.shift - dot(axis_, change.shift) * axis_ - foot * db_,
                slid_by = change.shift - foot * b_.turn;
    if constexpr (Feet::kTwo) {
      dx += foot_a * da_;
      slid_by += foot_a * a_.turn;
    }
    // At the foot of a smooth strand b' is across n.
    const Lanes nearer = -1.0 * dot(n_, Feet::kTwo ? dx : change.shift);
    const FourVectors dn = over_d_ * (dx + nearer * n_);
    const Section::Change a = a_.change(change.turn_a, change.turn_a, change.spin_a);
    const Section::Change b = b_.change(change.turn_b + foot * bend_b_, change.turn_b + foot * bend_turn_b_,
                                        change.spin_b + foot * spin_slope_b_);
    // Slip: d(xi + alpha n x xi + u)
    const FourVectors rotation = a.rotation + b.rotation;
    const Lanes alpha = carried_ * (dot(n_, rotation) + dot(dn, rotation_));
    FourVectors dr = slid_by - cross(rotation, lever_ * x_) - cross(rotation_, lever_ * dx) +
                     alpha * cross(n_, remembered_) + alpha_ * cross(dn, remembered_);
    if (on_roller_) dr -= cross(axis_, ((1.0 - lever_) * change.turned) * x_ + turned_ * dx);
    const FourVectors slid = dr - dot(n_, dr) * n_ - away_ * dn - dot(r_, dn) * n_;
    const FourVectors dg = nearer * pressing_ + turning_ * dn - stiffness_ * friction_.slope_times(slid);
    const FourVectors dm = cross(lever_ * dx, force_) + cross(lever_ * x_, dg);
    const FourVectors on_a = cross(a.over, m_) + cross(a_.over, dm), on_b = cross(b.over, m_) + cross(b_.over, dm);
    const Parted forces(-1.0 * dg), all_a(-1.0 * on_a, dot(a.over, m_) + dot(a_.over, dm)),
        all_b(-1.0 * on_b, dot(b.over, m_) + dot(b_.over, dm));
    for (std::size_t i = 0; i < 4; ++i)
      models[i].by[number] = {forces[i], all_a[i], all_b[i], foot_a[static_cast<int>(i)], foot[static_cast<int>(i)]};
  }

  bool on_roller_;
  FourPressures pressures_;
  Feet feet_;
  Section a_, b_;
  FourVectors bend_b_, bend_turn_b_;
  Lanes spin_slope_b_, lever_;
  FourVectors x_, n_, da_, db_, axis_, r_, remembered_;
  Lanes over_d_, turned_;
  FourVectors rotation_;  // phi_a + phi_b
  double carried_;
  Lanes alpha_, away_;  // n.r
  FrictionTangent<FourVectors> friction_;
  Lanes turning_, stiffness_;
  FourVectors pressing_, force_, m_;
};

/// phi_a + phi_b
Vec3 section_rotation(const ContactPoint& contact, const SurfacePoint& surface) {
  return rotation(surface.along_a, surface.turn_a, surface.spin_a) + rotation(contact.db, contact.turn, surface.spin_b);
}

using Contacts4 = std::array<const ContactPoint*, 4>;

/// Calls `fill(law, four contacts, their surfaces, their models)`.
template <typename Fill>
void linearise_with(const Friction& friction, const std::vector<ContactPoint>& contacts,
                    const std::vector<SurfacePoint>& surfaces, std::vector<SurfaceModel>& models, Fill fill) {
  models.resize(contacts.size() + 3);  // room for the fours that the last one fills up
  friction.visit([&](const auto& law) {
    visit_active(contacts, [&](const Contacts4& four, std::size_t first) {
      Points4 points;
      for (std::size_t i = 0; i < 4; ++i) points[i] = &surfaces[static_cast<std::size_t>(four[i] - contacts.data())];
      fill(law, four, points, &models[first]);
    });
  });
}

}  // namespace

Vec3 rolling(const ContactPoint& contact, const SurfacePoint& surface) {
  return -surface.lever * section_rotation(contact, surface).cross(contact.x);
}

Vec3 surface_shift(const ContactPoint& contact, const SurfacePoint& surface) {
  const Vec3 phi = section_rotation(contact, surface);
  return carried(contact) * contact.n.dot(phi) * contact.n.cross(contact.memory.slip) -
         surface.lever * phi.cross(contact.x);
}

void add_couples(const ContactPoint& contact, const SurfacePoint& surface, const Lanes& g, std::vector<Lanes>& force) {
  const Vec3 m = surface.lever * contact.x.cross(to_vec3(g));
  const auto add = [&](int first, const Vec3& along, const double* d, const double* s) {
    const Vec3 over = along / along.squaredNorm();
    const Lanes bends = to_lanes(Vec3(over.cross(m)));
    const double spins = -over.dot(m);
    for (int k = 0; k < 3; ++k) force[static_cast<std::size_t>(first + k)] += d[k] * bends;
    for (int j = 0; j < 2; ++j) force[static_cast<std::size_t>(first + j)][3] += s[j] * spins;
  };
  add(contact.a0, surface.along_a, surface.d_a, surface.s_a);
  if (!contact.on_roller()) add(contact.b0, contact.db, contact.beta + 3, surface.s_b);
}

void linearise(const NormalLaw& normal, const Friction& friction, double dt, const ContactLinearisation& how,
               const std::vector<ContactPoint>& contacts, const std::vector<SurfacePoint>& surfaces,
               std::vector<SurfaceModel>& models) {
  linearise_with(friction, contacts, surfaces, models,
                 [&](const auto& law, const Contacts4& four, const Points4& points, SurfaceModel* to) {
                   const Four<const ContactPoint> of(four);
                   const OneFoot foot{of(&ContactPoint::inverse_g)};
                   FourSurfaces(FourPressures(normal, how, of), law, dt, how, four, points, foot).model(to);
                 });
}

void linearise(const EdgeLaw& normal, const Friction& friction, double dt, const ContactLinearisation& how,
               const std::vector<ContactPoint>& contacts, const std::vector<SurfacePoint>& surfaces,
               const std::vector<EdgeFeet>& feet, std::vector<SurfaceModel>& models) {
  linearise_with(friction, contacts, surfaces, models,
                 [&](const auto& law, const Contacts4& four, const Points4& points, SurfaceModel* to) {
                   FourPressures pressures;
                   TwoFeet both;
                   for (std::size_t i = 0; i < 4; ++i) {
                     const int lane = static_cast<int>(i);
                     const EdgePressure p = pressure_of(normal, how, *four[i]);
                     pressures.slope[lane] = p.slope;
                     pressures.pressure[lane] = p.pressure;
                     pressures.turning[lane] = p.turning;
                     const EdgeFeet& feet_of = feet[static_cast<std::size_t>(four[i] - contacts.data())];
                     both.tt[lane] = feet_of.inverse_tt;
                     both.tu[lane] = feet_of.inverse_tu;
                     both.uu[lane] = feet_of.inverse_uu;
                   }
                   FourSurfaces(pressures, law, dt, how, four, points, both).model(to);
                 });
}

}  // namespace knot_utm
