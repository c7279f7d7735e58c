#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "four_contacts.hpp"
#include "knot_utm/contact/surface_contact.hpp"

// What four contacts with friction at the surfaces have in common, whether their forces are evaluated or linearised.
// Symbols as in SurfacePoint and RollingResistance.

namespace knot_utm {

/// Fraction of the rotation by which friction's memory turns about n: both sections carry it, or the one on a roller.
inline double carried(const ContactPoint& contact) { return contact.on_roller() ? 1.0 : 0.5; }

using Contacts4 = std::array<const ContactPoint*, 4>;
using Points4 = std::array<const SurfacePoint*, 4>;

inline Lanes four(const Points4& surfaces, double SurfacePoint::*number) {
  return Lanes{surfaces[0]->*number, surfaces[1]->*number, surfaces[2]->*number, surfaces[3]->*number};
}
inline FourVectors four(const Points4& surfaces, Vec3 SurfacePoint::*vector) {
  return FourVectors::of(to_lanes(surfaces[0]->*vector), to_lanes(surfaces[1]->*vector), to_lanes(surfaces[2]->*vector),
                         to_lanes(surfaces[3]->*vector));
}

inline Lanes lever_of(const Points4& surfaces) { return four(surfaces, &SurfacePoint::lever); }

/// q of four contacts between strands of the same radius, or on rollers: 1, which costs nothing.
struct EvenLevers {
  static constexpr bool kEven = true;
  const FourVectors& times_q(const FourVectors& of_b) const { return of_b; }
};
/// The same between strands of different radii.
struct UnevenLevers {
  static constexpr bool kEven = false;
  Lanes q;
  explicit UnevenLevers(const Points4& surfaces) : q(four(surfaces, &SurfacePoint::uneven)) {}
  FourVectors times_q(const FourVectors& of_b) const { return q * of_b; }
};

/// Of all four contacts of one pair of materials, or of none.
inline bool is_even(const Points4& surfaces) { return surfaces[0]->uneven == 1.0; }

inline FourVectors times_q(const Points4& surfaces, const FourVectors& of_b) {
  return is_even(surfaces) ? of_b : UnevenLevers(surfaces).times_q(of_b);
}

inline std::size_t number_of(const ContactPoint* contact, const std::vector<ContactPoint>& contacts) {
  return static_cast<std::size_t>(contact - contacts.data());
}

template <typename Contact>
Points4 points_of(const std::array<Contact*, 4>& four, const std::vector<ContactPoint>& contacts,
                  const std::vector<SurfacePoint>& surfaces) {
  Points4 out;
  for (std::size_t i = 0; i < 4; ++i) out[i] = &surfaces[number_of(four[i], contacts)];
  return out;
}

/// The sections of four strands.
struct Section {
  FourVectors over;  // c^
  Lanes length2, over_length2;
  FourVectors turn;
  Lanes spin;

  Section(const FourVectors& along, const FourVectors& turn_, const Lanes& spin_)
      : length2(dot(along, along)), turn(turn_), spin(spin_) {
    const Lanes none = Lanes{};
    over_length2 = select(length2 > 0.0, 1.0 / length2, none);
    over = over_length2 * along;
  }

  static Section of_a(const Points4& surfaces) {
    return {four(surfaces, &SurfacePoint::along_a), four(surfaces, &SurfacePoint::turn_a),
            four(surfaces, &SurfacePoint::spin_a)};
  }
  template <typename Contact>
  static Section of_b(const Four<Contact>& contacts, const Points4& surfaces) {
    return {contacts(&ContactPoint::db), contacts(&ContactPoint::turn), four(surfaces, &SurfacePoint::spin_b)};
  }

  FourVectors rotation() const { return cross(over, turn) + spin * over; }

  /// As c', V and Psi change.
  struct Change {
    FourVectors over = {}, rotation = {};
  };
  Change change(const FourVectors& longer, const FourVectors& turned, const Lanes& spun) const {
    Change out;
    out.over = over_length2 * longer - (2.0 * dot(over, longer)) * over;
    out.rotation = cross(out.over, turn) + cross(over, turned) + spun * over + spin * out.over;
    return out;
  }
  /// As Psi alone changes, by 1.
  Change spun() const { return {FourVectors{}, over}; }
};

/// mu_r(p), and d(mu_r p)/dp, of four contacts. A linear model may have a pressure below zero.
inline Lanes square_root_of(const RollingResistance& rolling, const Lanes& pressure) {
  return rolling.growth * square_root(larger(pressure, Lanes{}));
}
inline Lanes rolling_coefficient(const RollingResistance& rolling, const Lanes& pressure) {
  if (rolling.growth == 0.0) return constant<Lanes>(rolling.coefficient);
  return rolling.coefficient + square_root_of(rolling, pressure);
}
inline Lanes rolling_slope(const RollingResistance& rolling, const Lanes& pressure) {
  if (rolling.growth == 0.0) return constant<Lanes>(rolling.coefficient);
  return rolling.coefficient + 1.5 * square_root_of(rolling, pressure);
}

/// The resistance of four contacts to rolling.
struct FourRolling {
  FourVectors line;   // l
  FourVectors turns;  // phi_a - phi_b
  Lanes zeta;
  Lanes slope, secant;  // rho_s dzeta/drho, and zeta/y

  template <typename Contact>
  FourRolling(const RollingResistance& rolling, const std::array<Contact*, 4>& contacts, const Points4& surfaces,
              const FourVectors& axis, const Section& a, const Section& b, Linearisation how)
      : line(square_root(a.length2) * a.over),
        turns(a.rotation() - b.rotation() - four(surfaces, &SurfacePoint::turned) * axis) {
    const Lanes remembered{contacts[0]->memory.rolled, contacts[1]->memory.rolled, contacts[2]->memory.rolled,
                           contacts[3]->memory.rolled};
    const Lanes y = (1.0 / rolling.presliding) * (remembered + rolling.radius * dot(line, turns)), size = larger(y, -y);
    const Lanes one = constant<Lanes>(1.0);
    secant = select(size < 1.0, one, 1.0 / size);
    zeta = secant * y;
    slope = how == Linearisation::kTangent ? select(size < 1.0, one, Lanes{}) : secant;
  }
};

}  // namespace knot_utm
