#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "knot_utm/contact/roller_contact.hpp"
#include "knot_utm/numeric/index.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/force_term.hpp"
#include "knot_utm/sim/frame_terms.hpp"
#include "knot_utm/sim/step_account.hpp"
#include "knot_utm/sim/step_matrix.hpp"

namespace knot_utm {

/// Pressure and friction of one kind of contacts, either between strands or on rollers: a force term (force_term.hpp)
/// of a step with D unknowns per node. `Contacts` (SmoothContact or RollerContact) decides what a contact
/// is, where it acts and by which laws. With the symbols of ContactPoint, the forces on the nodes are
///
///   f_k = c_k g        on nodes a0..a0+2 and, between strands, b0..b0+2       [N]
///
/// Where friction acts at the surfaces, the couples of surface_contact.hpp on nodes and spins are added. The next
/// increment is solved with the linear model of every contact, whose force replaces g in the right-hand side.
template <int D, typename Contacts>
class ContactTerm : public ForceTerm {
 public:
  static constexpr bool kOnRollers = std::is_same_v<Contacts, RollerContact>;

  explicit ContactTerm(Contacts contacts) : contacts_(std::move(contacts)) {}

  void part(int edge) { contacts_.part(edge); }
  Contacts& contacts() { return contacts_; }
  const Contacts& contacts() const { return contacts_; }
  const std::vector<ContactPoint>& points() const { return contacts_.contacts(); }

  void begin(const StepStart& start, bool) {
    if constexpr (kOnRollers)
      contacts_.begin(start.boundary.rollers, start.state.position);
    else
      contacts_.begin(start.state.position);
  }

  void add_forces(const StepStart& start, const Points& x, std::vector<Lanes>& force) {
    if constexpr (kOnRollers)
      contacts_.evaluate(start.boundary.rollers, x, start.state.position, start.dt);
    else
      contacts_.evaluate(x, start.state.position, start.dt);
    for (std::size_t i = 0; i < points().size(); ++i) {
      const ContactPoint& contact = points()[i];
      if (!contact.touches()) continue;
      add_force(contact, to_lanes(contact.force), force);
      if constexpr (D == 4)
        if (contacts_.at_surface()) {
          const SurfacePoint& surface = contacts_.surfaces()[i];
          add_couples(contact, surface, surface.on_a, surface.on_b, force);
        }
    }
  }

  /// Adds to the right-hand side the difference between the forces of the linear models and g.
  void add_stiffness(LinearSystem<D>& system) {
    pressures_.clear();
    if constexpr (D == 4)
      if (contacts_.at_surface()) return add_surface_stiffness(system);
    contacts_.linearise(system.how, system.start.dt, models_);
    for (const ContactPoint& contact : points()) {
      if (!contact.active()) continue;
      const Model& model = models_[pressures_.size()];
      add_force(contact, model.force - to_lanes(contact.force), system.right);
      system.matrix.add(contact, model, pressures_.size());
      pressures_.push_back({model.pressure, model.slope});
    }
  }

  /// Stores for each contact the pressure that its linear model predicts after `factor` times the change of the
  /// unknowns. The next linear system uses this prediction (ContactModel).
  void predict(const std::vector<Lanes>& change, double factor) {
    std::size_t n = 0;
    for (ContactPoint& contact : contacts_.contacts()) {
      if (!contact.active()) continue;
      const LinearPressure& p = pressures_[n++];
      if (contacts_.soft()) {
        contact.prediction = p.pressure + factor * p.slope * overlap_change(contact, change);
        continue;
      }
      Lanes moved = {};
      for (int k = 0; k < 3; ++k) {
        moved += contact.c[k] * change[at(contact.a0 + k)];
        if (!contact.on_roller()) moved += contact.c[3 + k] * change[at(contact.b0 + k)];
      }
      contact.prediction = p.pressure - factor * p.slope * dot(to_lanes(contact.n), moved);
    }
  }

  void account(const SolvedStep& step, StepAccount& account) const {
    for (const ContactPoint& contact : points()) {
      const ContactMotion motion = contacts_.motion(contact, step.end, step.state.position);
      const double now = motion.weight * contacts_.energy(contact.pair, contact.overlap);
      const double before = motion.weight_before * contacts_.energy(contact.pair, motion.overlap_before);
      account.energies.contact += now;
      account.work.reweighting -= before;
      account.work.numerical += before - now;
      if (!contact.touches()) continue;
      const double force = contact.weight * contact.pressure;
      account.work.numerical -= force * contact.n.dot(motion.slip) + motion.thinning;
      account.work.friction += contact.mu * force * contact.z.dot(motion.slip + motion.rolling);
      if constexpr (D == 4)
        if (contacts_.at_surface())
          account.work.friction +=
              rolling_loss(contact, contacts_.surfaces()[static_cast<std::size_t>(&contact - points().data())]);
      if (contact.on_roller()) continue;
      ++account.contact.touching;
      account.contact.normal_force += force;
      account.contact.largest_overlap = std::max(account.contact.largest_overlap, contact.overlap);
      account.contact.couple += (1.0 - motion.passed_on) * contact.x.cross(contact.force);
    }
  }

  void commit(const SolvedStep& step) {
    if constexpr (kOnRollers)
      contacts_.commit(step.boundary.rollers);
    else
      contacts_.commit(step.end);
  }

 private:
  using Model = typename Contacts::Model;

  /// How the overlap of a contact between sections that give changes with the unknowns.
  double overlap_change(const ContactPoint& contact, const std::vector<Lanes>& change) const {
    const auto number = static_cast<std::size_t>(&contact - points().data());
    const SurfacePoint& surface = contacts_.surfaces()[number];
    Lanes shift = {}, turn_a = {}, turn_b = {};
    for (int k = 0; k < 3; ++k) {
      const Lanes& a = change[at(contact.a0 + k)];
      shift += contact.c[k] * a;
      turn_a += surface.d_a[k] * a;
      if (contact.on_roller()) continue;
      const Lanes& b = change[at(contact.b0 + k)];
      shift += contact.c[3 + k] * b;
      turn_b += contact.beta[3 + k] * b;
    }
    return knot_utm::overlap_change(contact, surface, contacts_.soft_points()[number], to_vec3(shift), to_vec3(turn_a),
                                    to_vec3(turn_b));
  }

  /// The pressure of the linear model of a contact, and its slope.
  struct LinearPressure {
    double pressure, slope;  // at the present overlap [N/m], and per overlap [N/m^2]
  };

  /// Adds the nodal forces of the force g that acts on side a of a contact.
  static void add_force(const ContactPoint& contact, const Lanes& g, std::vector<Lanes>& to) {
    for (int k = 0; k < 3; ++k) to[at(contact.a0 + k)] += contact.c[k] * g;
    if (!contact.on_roller())
      for (int k = 0; k < 3; ++k) to[at(contact.b0 + k)] += contact.c[3 + k] * g;
  }

  void add_surface_stiffness(LinearSystem<D>& system) {
    linearise_surfaces(contacts_, system.how, system.start.dt, [&](std::size_t i, const SurfaceModel& model) {
      const ContactPoint& contact = points()[i];
      const SurfacePoint& surface = contacts_.surfaces()[i];
      add_force(contact, model.force - to_lanes(contact.force), system.right);
      add_couples(contact, surface, model.on_a - surface.on_a, model.on_b - surface.on_b, system.right);
      system.matrix.add(contact, surface, model, *system.spins, pressures_.size());
      pressures_.push_back({model.pressure, model.slope});
    });
  }

  Contacts contacts_;
  // Both lists hold one entry for each active contact, in order.
  std::vector<Model> models_;
  std::vector<LinearPressure> pressures_;
};

}  // namespace knot_utm
