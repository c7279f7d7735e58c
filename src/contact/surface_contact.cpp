#include "knot_utm/contact/surface_contact.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "four_contacts.hpp"
#include "four_surfaces.hpp"

namespace knot_utm {
namespace {

/// phi of one section; on a roller there is no second one.
Vec3 rotation(const Vec3& along, const Vec3& turn, double spin) {
  const double length2 = along.squaredNorm();
  if (length2 == 0.0) return Vec3::Zero();
  return (along.cross(turn) + spin * along) / length2;
}

/// phi_a + q phi_b
Vec3 section_rotation(const ContactPoint& contact, const SurfacePoint& surface, double q) {
  return rotation(surface.along_a, surface.turn_a, surface.spin_a) +
         q * rotation(contact.db, contact.turn, surface.spin_b);
}

}  // namespace

double RollingResistance::growth_of_hysteresis(double lost, double radius, double stretching_stiffness) {
  return 2.0 * lost / (3.0 * M_PI) * std::sqrt(3.0 * radius / stretching_stiffness);
}

FrictionMemory remember(const Friction& friction, const RollingLaws& rolling, const ContactPoint& contact,
                        const SurfacePoint& surface, double dt) {
  FrictionMemory out = remember(friction, contact, dt);
  out.rolled = rolling[contact.pair].presliding * surface.zeta;
  return out;
}

double rolling_loss(const ContactPoint& contact, const SurfacePoint& surface) {
  const Vec3 of_b =
      contact.on_roller() ? Vec3(surface.turned * contact.axis) : rotation(contact.db, contact.turn, surface.spin_b);
  return -surface.couple.dot(rotation(surface.along_a, surface.turn_a, surface.spin_a) - of_b);
}

Vec3 rolling(const ContactPoint& contact, const SurfacePoint& surface) {
  return -surface.lever * section_rotation(contact, surface, surface.uneven).cross(contact.x);
}

Vec3 surface_shift(const ContactPoint& contact, const SurfacePoint& surface) {
  const Vec3 phi = section_rotation(contact, surface, 1.0);
  return carried(contact) * contact.n.dot(phi) * contact.n.cross(contact.memory.slip) -
         surface.lever * section_rotation(contact, surface, surface.uneven).cross(contact.x);
}

void add_shifts(std::vector<ContactPoint>& contacts, const std::vector<SurfacePoint>& surfaces) {
  visit_active(contacts, [&](const std::array<ContactPoint*, 4>& four, std::size_t) {
    const Four<ContactPoint> of(four);
    const Points4 points = points_of(four, contacts, surfaces);
    const FourVectors of_a = Section::of_a(points).rotation(), of_b = Section::of_b(of, points).rotation();
    const FourVectors n = of(&ContactPoint::n), remembered = remembered_by(four);
    const Parted shifts((carried(*four[0]) * dot(n, of_a + of_b)) * cross(n, remembered) -
                        cross(of_a + times_q(points, of_b), lever_of(points) * of(&ContactPoint::x)));
    Vec3 slips[4];  // all of them, before any is written: the last contact may stand in several lanes
    for (std::size_t i = 0; i < 4; ++i) slips[i] = four[i]->slip + to_vec3(shifts[i]);
    for (std::size_t i = 0; i < 4; ++i) four[i]->slip = slips[i];
  });
}

void set_couples(const RollingLaws& laws, const std::vector<ContactPoint>& contacts,
                 std::vector<SurfacePoint>& surfaces) {
  visit_active(contacts, [&](const Contacts4& four, std::size_t) {
    const RollingResistance& rolling = laws[four[0]->pair];
    const Four<const ContactPoint> of(four);
    const Points4 points = points_of(four, contacts, surfaces);
    const FourVectors m = cross(lever_of(points) * of(&ContactPoint::x), of(&ContactPoint::force));
    const Section section_a = Section::of_a(points), section_b = Section::of_b(of, points);
    Lanes zeta = {};
    FourVectors couple = {};
    const FourVectors axis = of(&ContactPoint::axis);
    if (rolling.on()) {
      const FourRolling now(rolling, four, points, axis, section_a, section_b, Linearisation::kTangent);
      const Lanes pressure = of(&ContactPoint::pressure),
                  whole = -rolling_coefficient(rolling, pressure) * rolling.radius;
      zeta = now.zeta;
      couple = (whole * of(&ContactPoint::weight) * pressure * zeta) * now.line;
    }
    const FourVectors &a = section_a.over, &b = section_b.over, m_a = m - couple, m_b = times_q(points, m) + couple;
    const bool on_roller = four[0]->on_roller();
    const Parted on_a(cross(a, m_a), -1.0 * dot(a, m_a)),
        on_b(cross(b, m_b), -1.0 * dot(on_roller ? axis : b, on_roller ? couple : m_b));
    const Parted couples(couple);
    for (std::size_t i = 0; i < 4; ++i) {
      SurfacePoint& surface = surfaces[number_of(four[i], contacts)];
      surface.on_a = on_a[i];
      surface.on_b = on_b[i];
      surface.zeta = zeta[static_cast<int>(i)];
      surface.couple = to_vec3(couples[i]);
    }
  });
}

void add_couples(const ContactPoint& contact, const SurfacePoint& surface, const Lanes& on_a, const Lanes& on_b,
                 std::vector<Lanes>& force) {
  const auto add = [&](int first, const double* d, const double* s, const Lanes& on) {
    for (int k = 0; k < 3; ++k)
      force[static_cast<std::size_t>(first + k)] += Lanes{d[k], d[k], d[k], k < 2 ? s[k] : 0.0} * on;
  };
  add(contact.a0, surface.d_a, surface.s_a, on_a);
  if (!contact.on_roller()) add(contact.b0, contact.beta + 3, surface.s_b, on_b);
}

}  // namespace knot_utm
