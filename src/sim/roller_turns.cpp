#include "knot_utm/sim/roller_turns.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "knot_utm/numeric/index.hpp"
#include "surface_columns.hpp"

namespace knot_utm {
namespace {

double product(const std::vector<Lanes>& a, const std::vector<Lanes>& b) {
  Lanes sum = {};
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum[0] + sum[1] + sum[2] + sum[3];
}

}  // namespace

void RollerTurns::begin(const std::vector<Roller>& rollers, const RollerContact& contact, int nodes, double dt) {
  free_.clear();
  for (std::size_t r = 0; r < rollers.size(); ++r) {
    if (!rollers[r].free()) continue;
    if (free_.size() == borders_.size()) borders_.emplace_back();
    Border& border = borders_[free_.size()];
    free_.push_back(r);
    border.roller = static_cast<int>(r);
    border.radius = rollers[r].radius;
    border.column.assign(at(nodes), Lanes{});
    border.row.assign(at(nodes), Lanes{});
    border.diagonal = rollers[r].inertia / (dt * dt);
    border.torque = unbalanced(rollers, contact, border.roller, dt);
    border.change = 0.0;
  }
}

double RollerTurns::unbalanced(const std::vector<Roller>& rollers, const RollerContact& contact, int roller,
                               double dt) {
  const double acceleration = (contact.turned(roller) / dt - contact.turn(roller).rate) / dt;
  return contact.torque_on(roller) - rollers[at(roller)].inertia * acceleration;
}

double RollerTurns::largest_unbalanced(const std::vector<Roller>& rollers, const RollerContact& contact, double dt) {
  double largest = 0.0;
  for (std::size_t r = 0; r < rollers.size(); ++r)
    if (rollers[r].free())
      largest = std::max(largest, std::abs(unbalanced(rollers, contact, static_cast<int>(r), dt)) / rollers[r].radius);
  return largest;
}

RollerTurns::Border* RollerTurns::border_of(const ContactPoint& contact) {
  for (std::size_t n = 0; n < free_.size(); ++n)
    if (free_[n] == at(contact.roller)) return &borders_[n];
  return nullptr;
}

void RollerTurns::add(const ContactPoint& contact, const RollerModel& model) {
  Border* border = border_of(contact);
  if (border == nullptr) return;
  const Vec3 s = surface_increment(contact, 0.0), g = to_vec3(model.force);
  Lanes row = to_lanes(Vec3(g.cross(contact.axis)));
  for (int i = 0; i < 3; ++i) row[i] -= dot(to_lanes(s), model.still[i]);
  for (int k = 0; k < 3; ++k) {
    border->row[at(contact.a0 + k)] += contact.c[k] * row;
    border->column[at(contact.a0 + k)] += contact.c[k] * model.by_turn;
  }
  border->diagonal -= dot(to_lanes(s), model.by_turn);
  border->torque -= s.dot(g - contact.force);
}

void RollerTurns::add(const ContactPoint& contact, const SurfacePoint& surface, const SurfaceModel& model,
                      const SectionTurns& turns, bool soft) {
  Border* border = border_of(contact);
  if (border == nullptr) return;
  const Vec3 g = to_vec3(model.force), increment = surface_increment(contact, surface.lever);
  Vec3 push = (1.0 - surface.lever) * g.cross(contact.axis);
  if (soft) push -= contact.n.dot(push) * contact.n;
  const Lanes s = to_lanes(increment), pushed = to_lanes(push);
  const SurfaceModel::Response& by_turn = model.by[SurfaceModel::kTurned];
  const double spins[3] = {surface.s_a[0], surface.s_a[1], 0.0};
  const auto spin = spin_of_nodes(turns.pull, contact.a0, surface.s_a);
  for (int k = 0; k < 3; ++k) {
    const double d = surface.d_a[k];
    border->column[at(contact.a0 + k)] += contact.c[k] * by_turn.force + Lanes{d, d, d, spins[k]} * by_turn.on_a;
    const auto columns =
        columns_of(model, SurfaceModel::kTurnA, SurfaceModel::kSpinA, contact.c[k], d, spin[at(k)], spins[k]);
    Lanes row = contact.c[k] * pushed;
    for (int i = 0; i < 4; ++i) row[i] += columns[at(i)].on_b[3] - dot(s, columns[at(i)].force);
    border->row[at(contact.a0 + k)] += row;
  }
  border->diagonal += by_turn.on_b[3] - dot(s, by_turn.force);
  border->torque += model.on_b[3] - surface.on_b[3] - increment.dot(g - contact.force);
}

void RollerTurns::hold(int node, const Lanes& keep) {
  for (std::size_t n = 0; n < free_.size(); ++n) borders_[n].column[at(node)] *= keep;
}

template <int D>
bool RollerTurns::solve(BlockMatrix<D>& matrix, std::vector<Lanes>& change) {
  if (!matrix.solve_and_keep(change)) return false;
  const auto count = static_cast<Eigen::Index>(free_.size());
  left_.resize(count, count);
  right_.resize(count);
  for (std::size_t n = 0; n < free_.size(); ++n) matrix.solve_another(borders_[n].column);
  for (Eigen::Index n = 0; n < count; ++n) {
    const Border& border = borders_[static_cast<std::size_t>(n)];
    right_[n] = border.torque - product(border.row, change);
    for (Eigen::Index m = 0; m < count; ++m)
      left_(n, m) =
          (n == m ? border.diagonal : 0.0) - product(border.row, borders_[static_cast<std::size_t>(m)].column);
  }
  factors_.compute(left_);
  turns_ = factors_.solve(right_);
  if (!turns_.allFinite()) return false;
  for (Eigen::Index n = 0; n < count; ++n) {
    Border& border = borders_[static_cast<std::size_t>(n)];
    border.change = turns_[n];
    for (std::size_t i = 0; i < change.size(); ++i) change[i] -= border.change * border.column[i];
  }
  return true;
}

template bool RollerTurns::solve(BlockMatrix<3>&, std::vector<Lanes>&);
template bool RollerTurns::solve(BlockMatrix<4>&, std::vector<Lanes>&);

double RollerTurns::largest_motion() const {
  double largest = 0.0;
  for (std::size_t n = 0; n < free_.size(); ++n)
    largest = std::max(largest, std::abs(borders_[n].change) * borders_[n].radius);
  return largest;
}

void RollerTurns::move(RollerContact& contact, double factor) const {
  for (std::size_t n = 0; n < free_.size(); ++n) contact.turn_on(borders_[n].roller, factor * borders_[n].change);
}

}  // namespace knot_utm
