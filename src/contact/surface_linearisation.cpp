#include "four_contacts.hpp"
#include "four_surfaces.hpp"
#include "knot_utm/contact/soft_section.hpp"
#include "knot_utm/contact/surface_contact.hpp"

namespace knot_utm {
namespace {

FourVectors unit_vector(int component) {
  FourVectors out = {};
  (component == 0 ? out.x : component == 1 ? out.y : out.z) = constant<Lanes>(1.0);
  return out;
}

/// How far a direction of friction or rolling has turned by `apart` from that of the last trial: 0 where it hardly has,
/// 1 where it points elsewhere, 0 where there was none, `old` squared being 0.
Lanes turned_from(const Lanes& apart, const Lanes& old2) {
  constexpr double kHardly = 0.2, kElsewhere = 0.7;
  const Lanes part = (apart - kHardly) / (kElsewhere - kHardly), none = {};
  return select(old2 > 0.0, smaller(larger(part, none), constant<Lanes>(1.0)), none);
}
Lanes turned_from(const FourVectors& old, const FourVectors& z) {
  const FourVectors apart = z - old;
  return turned_from(square_root(dot(apart, apart)), dot(old, old));
}

/// Sections that keep their radius, which costs nothing.
struct RoundSections {
  static constexpr bool kSoft = false;
};

/// Four contacts between sections that give (SoftPoint), with the pressure law of a tangent: of k D, e_0 is a parabola.
struct SoftSections {
  static constexpr bool kSoft = true;
  Lanes scale, share_a, share_b, apart, rest_growth;  // apart: Z_0 - k D
  Lanes both, both_slope, energy;                     // S, dS/d(kD) and e_0 of the tangent
  Lanes pressure, weight;                             // p_0 of it, w/k^2
  Lanes thins_a, thins_b;                             // R of the tangent
  Lanes turning_a, turning_b;                         // R of the terms in which a^ and w change

  SoftSections(const NormalLaw& normal, const FourPressures& pressures, const Contacts4& contacts,
               const std::array<const SoftPoint*, 4>& soft)
      : pressure(pressures.pressure) {
    const Four<const ContactPoint> of(contacts);
    const auto lanes = [&](double SoftPoint::*number) {
      return Lanes{soft[0]->*number, soft[1]->*number, soft[2]->*number, soft[3]->*number};
    };
    scale = lanes(&SoftPoint::scale);
    share_a = lanes(&SoftPoint::share_a);
    share_b = lanes(&SoftPoint::share_b);
    rest_growth = lanes(&SoftPoint::rest_growth);
    weight = of(&ContactPoint::weight) / scale;
    const Lanes sum = lanes(&SoftPoint::sum), overlap = of(&ContactPoint::overlap), beyond = overlap - pressures.at;
    apart = sum - overlap;
    Lanes energy_at;
    for (int i = 0; i < 4; ++i) energy_at[i] = normal.energy(pressures.at[i]);
    const Lanes pressure_at = pressure - pressures.slope * beyond;
    energy = energy_at + beyond * (pressure_at + 0.5 * pressures.slope * beyond);
    both = energy + 0.5 * pressure * apart;
    both_slope = 0.5 * (pressure + pressures.slope * apart);
    thins_a = weight * (share_a * both - energy);
    thins_b = weight * share_b * both;
    const Lanes none = {}, predicted = of(&ContactPoint::prediction);
    const Lanes both_at = energy_at + 0.5 * pressure_at * (sum - pressures.at);
    turning_a = select(predicted > none, weight * (share_a * both_at - energy_at), thins_a);
    turning_b = select(predicted > none, weight * share_b * both_at, thins_b);
  }

  /// dR_a and dR_b with k D.
  Lanes slope_a() const { return weight * (share_a * both_slope - pressure); }
  Lanes slope_b() const { return weight * share_b * both_slope; }
};

/// Four contacts at the point at which they are linearised; symbols as in SurfacePoint and ContactPoint.
template <typename Law, typename Levers = EvenLevers, typename Sections = RoundSections>
class FourSurfaces : private Levers {
 public:
  FourSurfaces(const FourPressures& pressures, const Law& law, const RollingResistance& rolling, double dt,
               const ContactLinearisation& how, const std::array<const ContactPoint*, 4>& contacts,
               const Points4& surfaces, const Levers& levers = {}, const Sections& sections = {})
      : Levers(levers),
        sections_(sections),
        pressures_(pressures),
        a_(Section::of_a(surfaces)),
        b_(Section::of_b(Four<const ContactPoint>(contacts), surfaces)),
        bend_b_(four(surfaces, &SurfacePoint::bend_b)),
        bend_turn_b_(four(surfaces, &SurfacePoint::bend_turn_b)),
        spin_slope_b_(four(surfaces, &SurfacePoint::spin_slope_b)),
        lever_(lever_of(surfaces)),
        on_roller_(contacts[0]->on_roller()) {
    const Four<const ContactPoint> of(contacts);
    x_ = of(&ContactPoint::x);
    n_ = of(&ContactPoint::n);
    db_ = of(&ContactPoint::db);
    axis_ = of(&ContactPoint::axis);
    r_ = of(&ContactPoint::slip);
    over_d_ = 1.0 / of(&ContactPoint::d);
    inverse_g_ = of(&ContactPoint::inverse_g);
    turned_ = of(&ContactPoint::turned);
    remembered_ = remembered_by(contacts);
    const FourVectors of_a = a_.rotation(), of_b = b_.rotation();
    rotation_ = of_a + of_b;
    sweeping_ = of_a + this->times_q(of_b);
    carried_ = carried(*contacts[0]);
    alpha_ = carried_ * dot(n_, rotation_);
    away_ = dot(n_, r_);
    const FourVectors tangential = r_ - away_ * n_;
    friction_ = law.tangent(friction_input(contacts, pressures_.turning, tangential, dt), how.friction);
    // Where the slip turns from one trial to the next, tangents may jump to and fro, and the secant stays on one side.
    friction_.along = (1.0 - turned_from(of(&ContactPoint::z_old), friction_.z)) * friction_.along;
    const Lanes weight = of(&ContactPoint::weight);
    turning_ = weight * pressures_.turning;
    stiffness_ = turning_ * friction_.stiffness;
    pressing_ = weight * pressures_.slope * (n_ - friction_.by_pressure);  // of the overlap
    force_ = weight * pressures_.pressure * (n_ - friction_.coefficient * friction_.z);
    m_ = cross(lever_ * x_, force_);
    if (rolling.on()) resist(rolling, contacts, surfaces, how, weight);
  }

  void model(SurfaceModel* models) const {
    const FourVectors m_a = m_ - couple_, m_b = this->times_q(m_) + couple_;
    FourVectors along_a = cross(a_.over, m_a), along_b = cross(b_.over, m_b);
    if constexpr (Sections::kSoft) {
      along_a += sections_.thins_a * a_.over;
      along_b += sections_.thins_b * b_.over;
    }
    const Parted forces(force_), on_a(along_a, -1.0 * dot(a_.over, m_a)),
        on_b(along_b, -1.0 * dot(on_roller_ ? axis_ : b_.over, on_roller_ ? couple_ : m_b));
    for (std::size_t i = 0; i < 4; ++i) {
      models[i].pressure = pressures_.pressure[static_cast<int>(i)];
      models[i].slope = pressures_.slope[static_cast<int>(i)];
      models[i].force = forces[i];
      models[i].on_a = on_a[i];
      models[i].on_b = on_b[i];
    }
    Response by_rotation[3], by_rolling;
    for (int i = 0; i < 3; ++i) by_rotation[i] = rotated(unit_vector(i));
    const Response by_twirl = Levers::kEven ? Response() : twirled();
    if (resists_) add_couple(by_rolling, couple_rolling_ * line_);
    const auto turned = [&](const Section::Change& a, const Section::Change& b) {
      return sections_change(by_rotation, by_twirl, by_rolling, a, b);
    };
    Response by_foot, longer_a, longer_b;
    if constexpr (Sections::kSoft) {
      longer_a = longer(sections_.share_a, true);
      if (!on_roller_) longer_b = longer(sections_.share_b, false);
    }
    if (!on_roller_) {
      by_foot = moved(-1.0 * db_, -1.0 * b_.turn);
      by_foot += turned(Section::Change(), b_.change(bend_b_, bend_turn_b_, spin_slope_b_));
      if constexpr (Sections::kSoft) by_foot.add(dot(b_.over, bend_b_) - sections_.rest_growth, longer_b);
    }
    // The foot of a strand, or none on a roller: du = (b'.S + x.V_b)/G.
    const auto add_foot = [&](Response response, const FourVectors& shift, const FourVectors& turn_b, int number) {
      const Lanes foot = inverse_g_ * (dot(db_, shift) + dot(x_, turn_b));
      if (!on_roller_) response.add(foot, by_foot);
      write(response, foot, number, models);
    };
    const Lanes still = {};
    const FourVectors none = {};
    for (int i = 0; i < 3; ++i) {
      const FourVectors unit = unit_vector(i);
      add_foot(moved(unit - dot(axis_, unit) * axis_, unit), unit, none, SurfaceModel::kShift + i);
      Response turns_a = turned(a_.change(unit, unit, still), Section::Change());
      if (resists_) add_couple(turns_a, swung(unit));
      if constexpr (Sections::kSoft) turns_a.add(dot(a_.over, unit), longer_a);
      write(turns_a, still, SurfaceModel::kTurnA + i, models);
      if (on_roller_) continue;
      Response turns_b = turned(Section::Change(), b_.change(unit, unit, still));
      if constexpr (Sections::kSoft) turns_b.add(dot(b_.over, unit), longer_b);
      add_foot(turns_b, none, unit, SurfaceModel::kTurnB + i);
    }
    write(turned(a_.spun(), Section::Change()), still, SurfaceModel::kSpinA, models);
    if (on_roller_) {
      Response by_turn = slipped(-1.0 * cross(axis_, (1.0 - lever_) * x_));
      if (resists_) by_turn.add(-1.0 * dot(axis_, line_), by_rolling);
      write(by_turn, still, SurfaceModel::kTurned, models);
    } else
      write(turned(Section::Change(), b_.spun()), still, SurfaceModel::kSpinB, models);
  }

 private:
  /// How g, a^ x m, b^ x m, and a^.m and b^.m change.
  struct Response {
    FourVectors force = {}, on_a = {}, on_b = {};
    Lanes torque_a = {}, torque_b = {};

    void add(const Lanes& times, const Response& o) {
      force += times * o.force;
      on_a += times * o.on_a;
      on_b += times * o.on_b;
      torque_a += times * o.torque_a;
      torque_b += times * o.torque_b;
    }
    void operator+=(const Response& o) { add(constant<Lanes>(1.0), o); }
  };

  /// To a force that changes by dg, and m by dm.
  Response responds(const FourVectors& dg, const FourVectors& dm) const {
    const FourVectors& on_b = this->times_q(dm);
    return {dg, cross(a_.over, dm), cross(b_.over, on_b), dot(a_.over, dm), dot(b_.over, on_b)};
  }

  /// What resists rolling, C and its derivatives.
  void resist(const RollingResistance& rolling, const std::array<const ContactPoint*, 4>& contacts,
              const Points4& surfaces, const ContactLinearisation& how, const Lanes& weight) {
    const FourRolling now(rolling, contacts, surfaces, axis_, a_, b_, how.friction);
    const Lanes old = Four<const ContactPoint>(contacts)(&ContactPoint::zeta_old);
    const Lanes turned = turned_from(larger(now.zeta - old, old - now.zeta), old * old);
    const auto whole = [&](const Lanes& coefficient) { return -coefficient * rolling.radius; };
    resists_ = true;
    line_ = now.line;
    turns_ = now.turns;
    size_ = whole(rolling_coefficient(rolling, pressures_.pressure)) * weight * pressures_.pressure * now.zeta;
    couple_ = size_ * line_;
    couple_pressing_ =
        (whole(rolling_slope(rolling, pressures_.pressure)) * weight * pressures_.slope * now.zeta) * line_;
    couple_rolling_ = (whole(rolling_coefficient(rolling, pressures_.turning)) * rolling.radius / rolling.presliding) *
                      turning_ * (now.slope + turned * (now.secant - now.slope));
  }

  /// dC as the line turns with a', dl = (1 - l l^T) da'/|a'|, while the sections stay.
  FourVectors swung(const FourVectors& longer) const {
    const FourVectors dl = square_root(a_.over_length2) * (longer - dot(line_, longer) * line_);
    return size_ * dl + (couple_rolling_ * dot(turns_, dl)) * line_;
  }

  /// A couple that changes by dC.
  void add_couple(Response& response, const FourVectors& dc) const {
    response.on_a -= cross(a_.over, dc);
    response.torque_a -= dot(a_.over, dc);
    response.on_b += cross(b_.over, dc);
    response.torque_b += dot(on_roller_ ? axis_ : b_.over, dc);
  }

  /// How the arm lambda x of friction changes with the gap. On a roller, sections that give touch it at its own radius
  /// r, so that x less the arm is r n.
  FourVectors arm(const FourVectors& dx) const {
    if constexpr (Sections::kSoft)
      if (on_roller_) return lever_ * dx + ((1.0 - lever_) * dot(n_, dx)) * n_;
    return lever_ * dx;
  }

  /// To a gap that changes by dx, and with it the slip by `slid_by` and all that turns with n; the sections stay.
  Response moved(const FourVectors& dx, const FourVectors& slid_by) const {
    const Lanes nearer = -1.0 * dot(n_, dx);
    Lanes pressed = nearer;
    if constexpr (Sections::kSoft) pressed = sections_.scale * nearer;
    const FourVectors dn = over_d_ * (dx + nearer * n_);
    // Slip: d(xi + alpha n x xi + u)
    FourVectors dr = slid_by - cross(sweeping_, arm(dx)) + (carried_ * dot(dn, rotation_)) * cross(n_, remembered_) +
                     alpha_ * cross(dn, remembered_);
    if (on_roller_) dr -= cross(axis_, turned_ * (Sections::kSoft ? dx - dot(n_, dx) * n_ : dx));
    const FourVectors slid = dr - dot(n_, dr) * n_ - away_ * dn - dot(r_, dn) * n_;
    const FourVectors dg = pressed * pressing_ + turning_ * dn - stiffness_ * friction_.slope_times(slid);
    Response out = responds(dg, cross(arm(dx), force_) + cross(lever_ * x_, dg));
    if (resists_) add_couple(out, pressed * couple_pressing_);
    if constexpr (Sections::kSoft) squeeze(out, pressed);
    return out;
  }

  /// R, as k D grows by so much.
  void squeeze(Response& out, const Lanes& pressed) const {
    out.on_a += (pressed * sections_.slope_a()) * a_.over;
    out.on_b += (pressed * sections_.slope_b()) * b_.over;
  }

  /// To a strand of the share chi that grows longer, by log lambda. That of the point bears on more of its length.
  Response longer(const Lanes& share, bool is_a) const {
    const Lanes wider = -0.5 * share, pressed = wider * sections_.apart, heavier = wider + (is_a ? 1.0 : 0.0);
    const FourVectors dg = pressed * pressing_ + (heavier * turning_) * (n_ - friction_.coefficient * friction_.z);
    Response out = responds(dg, cross(lever_ * x_, dg));
    if (resists_) add_couple(out, pressed * couple_pressing_ + heavier * couple_);
    squeeze(out, pressed);
    // chi_a changes against chi_b, and w/k^2 as heavier + wider says.
    const Lanes passed =
        (is_a ? -0.5 : 0.5) * sections_.share_a * sections_.share_b * sections_.weight * sections_.both;
    out.on_a += ((heavier + wider) * sections_.turning_a + passed) * a_.over;
    out.on_b += ((heavier + wider) * sections_.turning_b - passed) * b_.over;
    return out;
  }

  /// To slip that changes by dr while the gap stays.
  Response slipped(const FourVectors& dr) const {
    const FourVectors dg = -1.0 * stiffness_ * friction_.slope_times(dr - dot(n_, dr) * n_);
    return responds(dg, cross(lever_ * x_, dg));
  }

  /// To sections that turn by so much more.
  Response rotated(const FourVectors& phi) const {
    return slipped((carried_ * dot(n_, phi)) * cross(n_, remembered_) - cross(phi, lever_ * x_));
  }

  /// To a memory of friction that turns about n by so much more, and to nothing else.
  Response twirled() const { return slipped(carried_ * cross(n_, remembered_)); }

  /// To sections that change: they turn, and pass on their couples another way.
  Response sections_change(const Response* by_rotation, const Response& by_twirl, const Response& by_rolling,
                           const Section::Change& a, const Section::Change& b) const {
    const FourVectors phi = a.rotation + this->times_q(b.rotation), m_a = m_ - couple_,
                      m_b = this->times_q(m_) + couple_;
    Response out;
    out.on_a = cross(a.over, m_a);
    out.on_b = cross(b.over, m_b);
    if constexpr (Sections::kSoft) {
      out.on_a += sections_.turning_a * a.over;
      out.on_b += sections_.turning_b * b.over;
    }
    out.torque_a = dot(a.over, m_a);
    out.torque_b = dot(b.over, m_b);
    if (resists_) out.add(dot(line_, a.rotation - b.rotation), by_rolling);
    out.add(phi.x, by_rotation[0]);
    out.add(phi.y, by_rotation[1]);
    out.add(phi.z, by_rotation[2]);
    // phi turns that memory with q phi_b, but it turns with phi_b.
    if constexpr (!Levers::kEven) out.add(dot(n_, b.rotation - this->times_q(b.rotation)), by_twirl);
    return out;
  }

  void write(const Response& response, const Lanes& foot, int number, SurfaceModel* models) const {
    const Parted forces(-1.0 * response.force), all_a(-1.0 * response.on_a, response.torque_a),
        all_b(-1.0 * response.on_b, response.torque_b);
    for (std::size_t i = 0; i < 4; ++i)
      models[i].by[number] = {forces[i], all_a[i], all_b[i], foot[static_cast<int>(i)]};
  }

  Sections sections_;
  FourPressures pressures_;
  Section a_, b_;
  FourVectors bend_b_, bend_turn_b_;
  Lanes spin_slope_b_, lever_;
  FourVectors x_, n_, db_, axis_, r_, remembered_;
  Lanes over_d_, inverse_g_, turned_;
  FourVectors rotation_;  // phi_a + phi_b
  FourVectors sweeping_;  // phi_a + q phi_b
  Lanes alpha_, away_;    // n.r
  FrictionTangent<FourVectors> friction_;
  Lanes turning_, stiffness_;
  FourVectors pressing_, force_, m_;
  // Of the resistance to rolling.
  FourVectors line_, turns_, couple_ = {}, couple_pressing_;
  Lanes size_, couple_rolling_;  // -w mu_r h p zeta, and how it changes with the turns about l
  double carried_ = 0.0;
  bool on_roller_, resists_ = false;
};

/// Calls `fill(law, four contacts, their surfaces)` for the next four active ones from `from` on; the last one fills up
/// what is left.
template <typename FrictionOf, typename Fill>
std::size_t linearise_next(const FrictionOf& friction, const std::vector<ContactPoint>& contacts,
                           const std::vector<SurfacePoint>& surfaces, std::size_t from, SurfaceModels& models,
                           Fill fill) {
  Contacts4 four;
  Points4 points;
  models.count = 0;
  for (; from < contacts.size() && models.count < 4; ++from) {
    if (!contacts[from].active()) continue;
    if (models.count > 0 && contacts[from].pair != four[0]->pair) break;
    const auto i = static_cast<std::size_t>(models.count++);
    models.contact[i] = from;
    four[i] = &contacts[from];
    points[i] = &surfaces[from];
  }
  if (models.count == 0) return from;
  for (auto i = static_cast<std::size_t>(models.count); i < 4; ++i) {
    four[i] = four[i - 1];
    points[i] = points[i - 1];
  }
  friction(four[0]->pair).visit([&](const auto& law) { fill(law, four, points); });
  return from;
}

}  // namespace

std::size_t linearise(const ContactLaws& laws, const RollingLaws& rolling, double dt, const ContactLinearisation& how,
                      const std::vector<ContactPoint>& contacts, const std::vector<SurfacePoint>& surfaces,
                      const std::vector<SoftPoint>& soft, std::size_t from, SurfaceModels& models) {
  const auto friction = [&](int pair) -> const Friction& { return laws[pair].friction; };
  return linearise_next(
      friction, contacts, surfaces, from, models, [&](const auto& law, const Contacts4& four, const Points4& points) {
        const Four<const ContactPoint> of(four);
        const NormalLaw& normal = laws[four[0]->pair].normal;
        const FourPressures pressures(normal, how, of);
        if (!soft.empty()) {
          std::array<const SoftPoint*, 4> giving;
          for (std::size_t i = 0; i < 4; ++i) giving[i] = &soft[number_of(four[i], contacts)];
          FourSurfaces(pressures, law, rolling[four[0]->pair], dt, how, four, points, UnevenLevers(points),
                       SoftSections(normal, pressures, four, giving))
              .model(models.model);
          return;
        }
        const auto fill = [&](const auto& levers) {
          FourSurfaces(pressures, law, rolling[four[0]->pair], dt, how, four, points, levers).model(models.model);
        };
        is_even(points) ? fill(EvenLevers()) : fill(UnevenLevers(points));
      });
}

}  // namespace knot_utm
