#include "knot_utm/sim/step_readings.hpp"

#include <algorithm>
#include <string>

#include "knot_utm/numeric/index.hpp"
#include "knot_utm/rod/energy.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/scene.hpp"

namespace knot_utm {
namespace {

/// Calls add(node, weight) with weights on three nodes of the sum 1, of which those below zero count as zero.
template <class Add>
void share(const double* weights, double sign, int first, const Add& add) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += std::max(0.0, sign * weights[k]);
  for (int k = 0; k < 3; ++k) {
    const double weight = std::max(0.0, sign * weights[k]);
    if (weight > 0.0) add(first + k, weight / sum);
  }
}

/// Calls add(node, its share of the normal force [N], the direction of it) for both sides of those that touch.
template <class Add>
void each_share(const std::vector<ContactPoint>& contacts, const Add& add) {
  for (const ContactPoint& contact : contacts) {
    if (!contact.touches()) continue;
    const double normal = contact.weight * contact.pressure;
    share(contact.c, 1.0, contact.a0, [&](int node, double weight) { add(node, weight * normal, contact.n); });
    if (!contact.on_roller())
      share(contact.c + 3, -1.0, contact.b0, [&](int node, double weight) { add(node, weight * normal, -contact.n); });
  }
}

/// Adds to each node's force [N] its share of the normal forces of these contacts on the rod: w p, shared among the
/// nodes of either point by those of its weights c_k that are of its side's sign. For pictures: by the other weights of
/// a smooth centreline a strand would pull at its neighbours.
void add_normal_forces(const std::vector<ContactPoint>& contacts, Eigen::VectorXd& force) {
  each_share(contacts, [&](int node, double normal, const Vec3&) { force[node] += normal; });
}

/// Adds the same forces to what presses on each node.
void add_pressing(const std::vector<ContactPoint>& contacts, Pressing& pressing) {
  each_share(contacts, [&](int node, double normal, const Vec3& along) {
    pressing.col(node).head<3>() += normal * along;
    pressing(3, node) += normal;
  });
}

}  // namespace

StepReadings::StepReadings(const RodProperties& rod, const RodState& state, double spin,
                           const std::vector<ContactPoint>& strands, const RollerContact& rollers)
    : state_(state), strands_(strands), rollers_now_(rollers), force_(static_cast<std::size_t>(rod.nodes())) {
  const ElasticEnergy elastic = elastic_energy(rod, state);
  account_.energies.stretching = elastic.stretching;
  account_.energies.bending = elastic.bending;
  account_.energies.twisting = elastic.twisting;
  for (Eigen::Index i = 0; i < rod.nodes(); ++i)
    account_.energies.kinetic += 0.5 * rod.mass[i] * state.velocity.col(i).squaredNorm();
  account_.energies.kinetic += spin;
}

Vec3 StepReadings::reaction(int node) const { return -to_vec3(force_[at(node)]); }

double StepReadings::reaction_torque(int edge) const { return state_.twist.size() == 0 ? 0.0 : -force_[at(edge)][3]; }

std::vector<ContactForce> StepReadings::contact_forces() const {
  std::vector<ContactForce> out;
  for (const ContactPoint& contact : strands_) {
    if (contact.on_roller() || !contact.touches()) continue;
    Vec3 a = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      if (contact.c[k] != 0.0) a += contact.c[k] * state_.position.col(contact.a0 + k);
    out.push_back({a - 0.5 * contact.x, contact.force});
  }
  return out;
}

Eigen::VectorXd StepReadings::strand_normal_forces() const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(state_.position.cols());
  add_normal_forces(strands_, force);
  return force;
}

Eigen::VectorXd StepReadings::normal_forces() const {
  Eigen::VectorXd force = strand_normal_forces();
  add_normal_forces(rollers_now_.contacts(), force);
  return force;
}

Pressing StepReadings::pressing() const {
  Pressing out = Pressing::Zero(4, state_.position.cols());
  add_pressing(strands_, out);
  add_pressing(rollers_now_.contacts(), out);
  return out;
}

double StepReadings::normal_force_between(const NodeRange& a, const NodeRange& b) const {
  double sum = 0.0;
  for (const ContactPoint& contact : strands_) {
    if (contact.on_roller() || !contact.touches()) continue;
    const int on_a = contact.a0 + 1, on_b = contact.b0 + 1;  // the middle of their three nodes
    if ((a.holds(on_a) && b.holds(on_b)) || (a.holds(on_b) && b.holds(on_a))) sum += contact.weight * contact.pressure;
  }
  return sum;
}

double StepReadings::roller_normal_force(const NodeRange& piece) const {
  double sum = 0.0;
  for (const ContactPoint& contact : rollers_now_.contacts())
    if (contact.on_roller() && contact.touches() && piece.holds(contact.a0 + 1))
      sum += contact.weight * contact.pressure;
  return sum;
}

StepReadings::RollerLoad StepReadings::load_on(int roller) const {
  return at(roller) < roller_load_.size() ? roller_load_[at(roller)] : RollerLoad{};
}

StepAccount& StepReadings::begin(const SolvedStep& step) {
  const Energies before = account_.energies;
  account_ = StepAccount{};
  account_.before = before;
  account_.work.reweighting = before.contact;
  add_holders(step);
  add_rollers(step);
  force_ = step.force;
  first_ = false;
  return account_;
}

/// Adds the work of a force by its mean over the step. The step itself took the force as it is at the end.
void StepReadings::add_work_of_boundary(double at_end, double at_begin) {
  const double mean = first_ ? at_end : 0.5 * (at_begin + at_end);
  account_.work.boundary += mean;
  account_.work.numerical -= at_end - mean;
}

void StepReadings::add_holders(const SolvedStep& step) {
  for (const FixedNode& fixed : step.boundary.fixed_nodes) {
    const Vec3 increment = step.increment.col(fixed.node), holds = -to_vec3(step.force[at(fixed.node)]);
    add_work_of_boundary(holds.dot(increment), reaction(fixed.node).dot(increment));
    account_.loads.add(step.end.col(fixed.node), holds);
  }
  if (step.state.twist.size() == 0) return;
  for (const FixedTwist& fixed : step.boundary.fixed_twists) {
    const double turn = fixed.angle - step.state.twist[fixed.edge];
    const double holds = -step.force[at(fixed.edge)][3];
    add_work_of_boundary(holds * turn, reaction_torque(fixed.edge) * turn);
    account_.loads.moment += holds * Vec3(step.end.col(fixed.edge + 1) - step.end.col(fixed.edge)).normalized();
  }
}

void StepReadings::add_rollers(const SolvedStep& step) {
  load_before_.swap(roller_load_);
  roller_load_.clear();
  for (std::size_t r = 0; r < step.boundary.rollers.size(); ++r) {
    const Roller& roller = step.boundary.rollers[r];
    const int number = static_cast<int>(r);
    roller_load_.push_back({rollers_now_.force_on(number), rollers_now_.moment_on(roller, number, step.end)});
    account_.loads.add(roller.centre, -roller_load_[r].force);
    account_.loads.moment -= roller_load_[r].moment;
    if (r >= rollers_.size()) continue;
    const Vec3 moved = roller.centre - rollers_[r].centre;
    add_work_of_boundary(-roller_load_[r].force.dot(moved), -load_before_[r].force.dot(moved));
  }
  rollers_ = step.boundary.rollers;
}

void StepReadings::add_fall_of_elastic_energy() {
  account_.work.numerical += account_.before.elastic() - account_.energies.elastic();
}

void StepReadings::state(Archive& archive) {
  archive.section("REA4");  // "READ" had no sum of loads, "REA2" no plastic work, "REA3" rollers that turn
  for (Lanes& force : force_)
    for (int i = 0; i < 4; ++i) archive(reinterpret_cast<double*>(&force)[i]);
  archive(account_.contact, account_.energies, account_.work, first_);
  archive.list(rollers_);
  archive.list(roller_load_);
  archive.require(roller_load_.size() == rollers_.size(), "loads of rollers", std::to_string(roller_load_.size()));
  archive(account_.loads);
}

}  // namespace knot_utm
