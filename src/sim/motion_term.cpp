#include "motion_term.hpp"

#include "knot_utm/sim/step_matrix.hpp"

namespace knot_utm {

MotionTerm::MotionTerm(const RodProperties& rod, const StepSettings& settings) : rod_(rod), settings_(settings) {}

void MotionTerm::add_forces(const StepStart& start, const Points& x, std::vector<Lanes>& force) const {
  const double over_dt = 1.0 / start.dt;
  for (Eigen::Index i = 0; i < rod_.nodes(); ++i) {
    const Vec3 velocity = (x.col(i) - start.state.position.col(i) - start.middle_moves) * over_dt;
    const Vec3 acceleration = (velocity - (start.state.velocity.col(i) - start.middle_velocity)) * over_dt;
    const double drag = this->drag(start.boundary) * rod_.voronoi_length[i];
    force[static_cast<std::size_t>(i)] += to_lanes(rod_.mass[i] * (settings_.gravity - acceleration) - drag * velocity);
  }
}

template <int D>
void MotionTerm::add_stiffness(LinearSystem<D>& system) const {
  const double dt = system.start.dt, of_mass = 1.0 / (dt * dt), of_drag = drag(system.start.boundary) / dt;
  for (int i = 0; i < static_cast<int>(rod_.nodes()); ++i) {
    const double stiffness = of_mass * rod_.mass[i] + of_drag * rod_.voronoi_length[i];
    Block<D>& block = system.matrix.band(i, 0, 0);
    for (int k = 0; k < 3; ++k) block.column[k][k] += stiffness;
  }
}

template void MotionTerm::add_stiffness(LinearSystem<3>&) const;
template void MotionTerm::add_stiffness(LinearSystem<4>&) const;

void MotionTerm::account(const SolvedStep& step, StepAccount& account) const {
  const double drag = this->drag(step.boundary), work_of_drag = drag / step.dt;
  for (Eigen::Index i = 0; i < rod_.nodes(); ++i) {
    const Vec3 increment = step.increment.col(i), moved = increment - step.middle_moves, velocity = moved / step.dt;
    const Vec3 faster = velocity - (step.state.velocity.col(i) - step.middle_velocity);
    account.energies.kinetic += 0.5 * rod_.mass[i] * velocity.squaredNorm();
    account.work.numerical += 0.5 * rod_.mass[i] * faster.squaredNorm();
    account.work.boundary += rod_.mass[i] * settings_.gravity.dot(increment);
    account.work.drag += work_of_drag * rod_.voronoi_length[i] * moved.squaredNorm();
    const auto node = static_cast<std::size_t>(i);
    if (step.held[node] == 0) account.work.residual += to_vec3(step.force[node]).dot(increment);
    account.loads.add(step.end.col(i),
                      rod_.mass[i] * (settings_.gravity - faster / step.dt) - drag * rod_.voronoi_length[i] * velocity);
  }
}

}  // namespace knot_utm
