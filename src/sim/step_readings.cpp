#include "knot_utm/sim/step_readings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "knot_utm/contact/edge_contact.hpp"
#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/rod/energy.hpp"
#include "knot_utm/sim/roller_turns.hpp"

namespace knot_utm {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

std::vector<ContactForce> contact_forces(const std::vector<ContactPoint>& contacts, const Points& position) {
  std::vector<ContactForce> out;
  for (const ContactPoint& contact : contacts) {
    if (contact.on_roller() || !contact.touches()) continue;
    Vec3 a = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      if (contact.c[k] != 0.0) a += contact.c[k] * position.col(contact.a0 + k);
    out.push_back({a - 0.5 * contact.x, contact.force});
  }
  return out;
}

double normal_force_between(const std::vector<ContactPoint>& contacts, const NodeRange& a, const NodeRange& b) {
  double sum = 0.0;
  for (const ContactPoint& contact : contacts) {
    if (contact.on_roller() || !contact.touches()) continue;
    const int on_a = contact.a0 + 1, on_b = contact.b0 + 1;  // the middle of their three nodes
    if ((a.holds(on_a) && b.holds(on_b)) || (a.holds(on_b) && b.holds(on_a))) sum += contact.weight * contact.pressure;
  }
  return sum;
}

double roller_normal_force(const std::vector<ContactPoint>& contacts, const NodeRange& piece) {
  double sum = 0.0;
  for (const ContactPoint& contact : contacts)
    if (contact.on_roller() && contact.touches() && piece.holds(contact.a0 + 1))
      sum += contact.weight * contact.pressure;
  return sum;
}

StepReadings::StepReadings(const RodProperties& rod, const RodState& state, const StepSettings& settings, double spin)
    : rod_(rod), settings_(settings), force_(static_cast<std::size_t>(rod.nodes())) {
  const ElasticEnergy elastic = elastic_energy(rod, state);
  energies_.stretching = elastic.stretching;
  energies_.bending = elastic.bending;
  energies_.twisting = elastic.twisting;
  for (Eigen::Index i = 0; i < rod.nodes(); ++i)
    energies_.kinetic += 0.5 * rod.mass[i] * state.velocity.col(i).squaredNorm();
  energies_.kinetic += spin;
}

Vec3 StepReadings::reaction(int node) const { return -to_vec3(force_[at(node)]); }

StepReadings::RollerLoad StepReadings::load_on(int roller) const {
  return at(roller) < roller_load_.size() ? roller_load_[at(roller)] : RollerLoad{};
}

void StepReadings::begin(const SolvedStep& step, const RollerContact& rollers) {
  before_ = energies_;
  energies_ = Energies{};
  work_ = StepWork{};
  contact_ = ContactReading{};
  add_work_of_holders(step);
  add_work_of_rollers(step, rollers);
  for (const SlippingGrip& grip : step.boundary.grips)
    work_.boundary += grip.force(step.end.col(grip.node)) * grip.direction.dot(step.way.col(grip.node));
  for (const SpringHold& hold : step.boundary.holds)
    work_.boundary += hold.force(step.end.col(hold.node)).dot(step.way.col(hold.node));
  for (const NodeForce& force : step.boundary.forces) work_.boundary += force.force.dot(step.way.col(force.node));
  add_motion(step);
  add_free_turns(step, rollers);
  work_.reweighting = before_.contact;
  force_ = step.force;
  add_loads(step);
  first_ = false;
}

void StepReadings::add_loads(const SolvedStep& step) {
  loads_ = LoadSum();
  const Points& x = step.end;
  const Boundary& boundary = step.boundary;
  for (const FixedNode& fixed : boundary.fixed_nodes) loads_.add(x.col(fixed.node), reaction(fixed.node));
  if (step.start.twist.size() > 0)
    for (const FixedTwist& fixed : boundary.fixed_twists)
      loads_.moment += reaction_torque(fixed.edge) * Vec3(x.col(fixed.edge + 1) - x.col(fixed.edge)).normalized();
  for (std::size_t r = 0; r < boundary.rollers.size(); ++r) {
    loads_.add(boundary.rollers[r].centre, -roller_load_[r].force);
    loads_.moment -= roller_load_[r].moment;
  }
  for (const SlippingGrip& grip : boundary.grips)
    loads_.add(x.col(grip.node), grip.force(x.col(grip.node)) * grip.direction);
  for (const SpringHold& hold : boundary.holds) loads_.add(x.col(hold.node), hold.force(x.col(hold.node)));
  for (const NodeForce& force : boundary.forces) loads_.add(x.col(force.node), force.force);
  const double drag = settings_.drag + boundary.extra_drag;
  for (Eigen::Index i = 0; i < rod_.nodes(); ++i) {
    const Vec3 velocity = step.way.col(i) / step.dt, faster = velocity - step.start.velocity.col(i);
    loads_.add(x.col(i),
               rod_.mass[i] * (settings_.gravity - faster / step.dt) - drag * rod_.voronoi_length[i] * velocity);
  }
}

/// Of a force, by its mean over the step; the step itself took it as it is at the end.
void StepReadings::add_work_of_boundary(double at_end, double at_begin) {
  const double mean = first_ ? at_end : 0.5 * (at_begin + at_end);
  work_.boundary += mean;
  work_.numerical -= at_end - mean;
}

void StepReadings::add_work_of_holders(const SolvedStep& step) {
  for (const FixedNode& fixed : step.boundary.fixed_nodes) {
    const Vec3 way = step.way.col(fixed.node);
    add_work_of_boundary(-to_vec3(step.force[at(fixed.node)]).dot(way), -to_vec3(force_[at(fixed.node)]).dot(way));
  }
  if (step.start.twist.size() == 0) return;
  for (const FixedTwist& fixed : step.boundary.fixed_twists) {
    const double turn = fixed.angle - step.start.twist[fixed.edge];
    add_work_of_boundary(-step.force[at(fixed.edge)][3] * turn, -force_[at(fixed.edge)][3] * turn);
  }
}

void StepReadings::add_work_of_rollers(const SolvedStep& step, const RollerContact& rollers) {
  load_before_.swap(roller_load_);
  roller_load_.clear();
  for (std::size_t r = 0; r < step.boundary.rollers.size(); ++r) {
    const Roller& roller = step.boundary.rollers[r];
    const int number = static_cast<int>(r);
    roller_load_.push_back({rollers.force_on(number), rollers.moment_on(roller, number, step.end)});
    if (r >= rollers_.size()) continue;
    const Vec3 way = roller.centre - rollers_[r].centre;
    add_work_of_boundary(-roller_load_[r].force.dot(way), -load_before_[r].force.dot(way));
    if (!roller.free()) {
      const Vec3 turn = rollers.turned(number) * roller.axis;
      add_work_of_boundary(-roller_load_[r].moment.dot(turn), -load_before_[r].moment.dot(turn));
    }
  }
  rollers_ = step.boundary.rollers;
}

void StepReadings::add_free_turns(const SolvedStep& step, const RollerContact& rollers) {
  for (std::size_t r = 0; r < step.boundary.rollers.size(); ++r) {
    const Roller& roller = step.boundary.rollers[r];
    if (!roller.free()) continue;
    const int number = static_cast<int>(r);
    const double turn = rollers.turned(number), rate = turn / step.dt, faster = rate - rollers.turn(number).rate;
    energies_.kinetic += 0.5 * roller.inertia * rate * rate;
    work_.numerical += 0.5 * roller.inertia * faster * faster;
    work_.residual += RollerTurns::unbalanced(step.boundary.rollers, rollers, number, step.dt) * turn;
  }
}

/// Inertia, gravity, drag, and what Newton's method left unbalanced.
void StepReadings::add_motion(const SolvedStep& step) {
  const double drag = (settings_.drag + step.boundary.extra_drag) / step.dt;
  for (Eigen::Index i = 0; i < rod_.nodes(); ++i) {
    const Vec3 way = step.way.col(i), velocity = way / step.dt;
    energies_.kinetic += 0.5 * rod_.mass[i] * velocity.squaredNorm();
    work_.numerical += 0.5 * rod_.mass[i] * (velocity - step.start.velocity.col(i)).squaredNorm();
    work_.boundary += rod_.mass[i] * settings_.gravity.dot(way);
    work_.drag += drag * rod_.voronoi_length[i] * way.squaredNorm();
    const auto node = static_cast<std::size_t>(i);
    if (step.held[node] == 0) work_.residual += to_vec3(step.force[node]).dot(way);
  }
}

void StepReadings::add_elastic(const CentrelineTerms::Energy& centreline, const FrameTerms::Energy& frames) {
  energies_.stretching = centreline.stretching;
  energies_.bending = centreline.bending + frames.bending;
  energies_.twisting = frames.twisting;
  energies_.kinetic += frames.kinetic;
  loads_.moment -= frames.moment;
  work_.numerical += centreline.along;
  work_.numerical += frames.along + frames.inertia + frames.rest;
  work_.drag += frames.drag;
  work_.residual += frames.residual;
  work_.numerical += before_.elastic() - energies_.elastic();
}

template <typename Contacts>
void StepReadings::add_contacts(const SolvedStep& step, const Contacts& contacts) {
  for (const ContactPoint& contact : contacts.contacts()) {
    const ContactMotion motion = contacts.motion(contact, step.end, step.start.position);
    const double now = contact.weight * contacts.normal().energy(contact.overlap);
    const double before = contact.weight * contacts.normal().energy(motion.overlap_before);
    energies_.contact += now;
    work_.reweighting -= before;
    work_.numerical += before - now;
    if (!contact.touches()) continue;
    const double force = contact.weight * contact.pressure;
    work_.numerical -= force * contact.n.dot(motion.slip);
    work_.friction += contact.mu * force * contact.z.dot(motion.slip + motion.rolling);
    if (contact.on_roller()) continue;
    ++contact_.touching;
    contact_.normal_force += force;
    contact_.largest_overlap = std::max(contact_.largest_overlap, contact.overlap);
    contact_.couple += (1.0 - motion.passed_on) * contact.x.cross(contact.force);
  }
}

template void StepReadings::add_contacts(const SolvedStep&, const EdgeContact&);
template void StepReadings::add_contacts(const SolvedStep&, const SmoothContact&);
template void StepReadings::add_contacts(const SolvedStep&, const RollerContact&);

void StepReadings::state(Archive& archive) {
  archive.section("REA2");  // "READ" had no sum of loads
  for (Lanes& force : force_)
    for (int i = 0; i < 4; ++i) archive(reinterpret_cast<double*>(&force)[i]);
  archive(contact_, energies_, work_, first_);
  archive.list(rollers_);
  archive.list(roller_load_);
  archive.require(roller_load_.size() == rollers_.size(), "loads of rollers", std::to_string(roller_load_.size()));
  archive(loads_);
}

}  // namespace knot_utm
