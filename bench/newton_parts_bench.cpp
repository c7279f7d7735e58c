// The parts of one Newton iteration, for rods of 250 to 4000 nodes: the residual (elastic and contact forces), the
// assembly (elastic blocks into the matrix, linear models of the contacts) and factor and solve.
//
// The rod is straight but for its first third, a coil whose turns lie on each other, so that about as much of it is in
// contact as in a tightened fisherman's loop. Times are of one call; items are nodes.
#include <benchmark/benchmark.h>

#include <cmath>
#include <utility>
#include <vector>

#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/rod/isotropic_bending.hpp"
#include "knot_utm/rod/stretching.hpp"
#include "knot_utm/solver/block_matrix.hpp"

namespace knot_utm {
namespace {

constexpr double kRadius = 3e-3;     // h [m]
constexpr double kEdge = 3e-3;       // [m]
constexpr double kStretching = 4e4;  // k_s [N]
constexpr double kBending = 1e-4;    // k_b [N m^2]
constexpr double kCoilRadius = 5.0;  // [h]
constexpr double kPitch = 1.98;      // of the coil: the turns overlap by a hundredth of a diameter [h]
constexpr double kDt = 0.05;         // [s]

std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct Specimen {
  RodProperties rod;
  Points position, start;

  explicit Specimen(int nodes) {
    Material material;
    material.radius = kRadius;
    material.density = 900.0;
    material.stretching_stiffness = kStretching;
    material.bending_stiffness = kBending;
    rod = make_rod(material, Eigen::VectorXd::Constant(nodes - 1, kEdge));
    position.resize(3, nodes);
    const double rise = kPitch * kRadius / (2.0 * M_PI), turn = kEdge / std::hypot(kCoilRadius * kRadius, rise);
    for (int i = 0; i < nodes; ++i) {
      const double coil = turn * std::min(i, nodes / 3), along = kEdge * std::max(i - nodes / 3, 0);
      const Vec3 out(std::cos(coil), std::sin(coil), 0.0), forwards(-std::sin(coil), std::cos(coil), 0.0);
      position.col(i) = kCoilRadius * kRadius * out + rise * coil * Vec3::UnitZ() + along * forwards;
    }
    start = position;
    start.row(2) *= 1.0 + 1e-6;  // everything slips a little
  }

  Vec3 edge(int i) const { return position.col(i + 1) - position.col(i); }
  int nodes() const { return static_cast<int>(position.cols()); }

  SmoothContact contact() const {
    Friction friction;
    friction.coefficient = 0.6;
    friction.presliding = 2e-3 * kRadius;
    return {rod, NormalLaw{1e10, 0.05 * kRadius}, friction, 0.5 * kRadius};
  }

  /// Couplings of the rod itself and of its contacts.
  std::vector<std::pair<int, int>> couplings(const SmoothContact& contact) const {
    std::vector<std::pair<int, int>> pairs;
    for (int i = 0; i + 1 < nodes(); ++i) pairs.push_back({i, i + 1});
    for (int i = 0; i + 2 < nodes(); ++i) pairs.push_back({i, i + 2});
    for (const ContactPoint& point : contact.contacts())
      for (int k = 0; k < 9; ++k)
        if (point.a0 + k / 3 != point.b0 + k % 3) pairs.push_back({point.a0 + k / 3, point.b0 + k % 3});
    return pairs;
  }
};

void per_node(benchmark::State& state) { state.SetItemsProcessed(state.iterations() * state.range(0)); }

void residual_elastic(benchmark::State& state) {
  const Specimen specimen(static_cast<int>(state.range(0)));
  Points force(3, specimen.nodes());
  for (auto _ : state) {
    force.setZero();
    for (int i = 0; i + 1 < specimen.nodes(); ++i) {
      const Vec3 pull = stretching_gradient(kStretching, kEdge, specimen.edge(i)).gradient;
      force.col(i) += pull;
      force.col(i + 1) -= pull;
    }
    for (int i = 1; i + 1 < specimen.nodes(); ++i) {
      const auto bending = isotropic_bending_gradient(kBending, kEdge, specimen.edge(i - 1), specimen.edge(i));
      force.col(i - 1) += bending.gradient_e;
      force.col(i) += bending.gradient_f - bending.gradient_e;
      force.col(i + 1) -= bending.gradient_f;
    }
    benchmark::DoNotOptimize(force.data());
  }
  per_node(state);
}

void residual_contact(benchmark::State& state) {
  const Specimen specimen(static_cast<int>(state.range(0)));
  SmoothContact contact = specimen.contact();
  contact.refresh(specimen.position);
  contact.begin_step();
  for (auto _ : state) {
    contact.evaluate(specimen.position, specimen.start, kDt);
    benchmark::DoNotOptimize(contact.contacts().data());
  }
  state.counters["contacts"] = static_cast<double>(contact.contacts().size());
  per_node(state);
}

void assembly_elastic(benchmark::State& state) {
  const Specimen specimen(static_cast<int>(state.range(0)));
  const SmoothContact contact = specimen.contact();
  BlockPattern pattern;
  pattern.build(specimen.nodes(), specimen.couplings(contact));
  BlockMatrix<3> matrix;
  matrix.set_pattern(pattern);
  // Stored indices of the blocks (i, i + k), k = -2..2: looking them up is no part of the assembly.
  std::vector<int> band(5 * at(specimen.nodes()), -1);
  for (int i = 0; i < specimen.nodes(); ++i)
    for (int k = -2; k <= 2; ++k)
      if (i + k >= 0 && i + k < specimen.nodes()) band[at(5 * i + k + 2)] = pattern.index(i, i + k);
  const auto add = [&](int row, int column, const Mat3& m) {
    Block<3>& block = matrix.block(band[at(5 * row + column - row + 2)]);
    for (int j = 0; j < 3; ++j) block.column[j] += Lanes{m(0, j), m(1, j), m(2, j), 0.0};
  };
  for (auto _ : state) {
    matrix.set_zero();
    for (int i = 0; i + 1 < specimen.nodes(); ++i) {
      const Mat3 h = stretching(kStretching, kEdge, specimen.edge(i)).hessian;
      add(i, i, h);
      add(i + 1, i + 1, h);
      add(i, i + 1, -h);
      add(i + 1, i, -h);
    }
    for (int i = 1; i + 1 < specimen.nodes(); ++i) {
      const auto bending = isotropic_bending(kBending, kEdge, specimen.edge(i - 1), specimen.edge(i));
      const Mat3 &ee = bending.hessian_ee, &ef = bending.hessian_ef, &ff = bending.hessian_ff, fe = ef.transpose();
      add(i - 1, i - 1, ee);
      add(i - 1, i, ef - ee);
      add(i, i - 1, fe - ee);
      add(i - 1, i + 1, -ef);
      add(i + 1, i - 1, -fe);
      add(i, i, ee - ef - fe + ff);
      add(i, i + 1, ef - ff);
      add(i + 1, i, fe - ff);
      add(i + 1, i + 1, ff);
    }
    benchmark::ClobberMemory();
  }
  per_node(state);
}

void assembly_contact(benchmark::State& state) {
  const Specimen specimen(static_cast<int>(state.range(0)));
  SmoothContact contact = specimen.contact();
  contact.refresh(specimen.position);
  contact.begin_step();
  contact.evaluate(specimen.position, specimen.start, kDt);
  std::vector<ContactModel> models(contact.contacts().size());
  double active = 0.0;
  for (auto _ : state) {
    std::size_t used = 0;
    for (const ContactPoint& point : contact.contacts())
      if (point.active()) contact.linearise_contact(point, kDt, models[used++]);
    active = static_cast<double>(used);
    benchmark::DoNotOptimize(models.data());
  }
  state.counters["active"] = active;
  per_node(state);
}

void factor_and_solve(benchmark::State& state) {
  const Specimen specimen(static_cast<int>(state.range(0)));
  SmoothContact contact = specimen.contact();
  contact.refresh(specimen.position);
  contact.begin_step();
  contact.evaluate(specimen.position, specimen.start, kDt);
  BlockPattern pattern;
  pattern.build(specimen.nodes(), specimen.couplings(contact));
  BlockMatrix<3> matrix;
  matrix.set_pattern(pattern);
  BlockMatrix<3>::Vector x(at(specimen.nodes()));
  std::vector<int> diagonal;
  for (int i = 0; i < specimen.nodes(); ++i) diagonal.push_back(pattern.index(i, i));
  for (auto _ : state) {
    // The values do not matter to the time.
    matrix.set_zero();
    for (const int block : diagonal) matrix.block(block).set_identity();
    x.assign(at(specimen.nodes()), Lanes{1.0, 1.0, 1.0, 0.0});
    if (!matrix.factor()) return state.SkipWithError("singular");
    matrix.solve(x);
    benchmark::DoNotOptimize(x.data());
  }
  state.counters["blocks"] = pattern.blocks();
  per_node(state);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (int nodes = 250; nodes <= 4000; nodes *= 2) benchmark->Arg(nodes);
  benchmark->Unit(benchmark::kMicrosecond);
}

BENCHMARK(residual_elastic)->Apply(sizes);
BENCHMARK(residual_contact)->Apply(sizes);
BENCHMARK(assembly_elastic)->Apply(sizes);
BENCHMARK(assembly_contact)->Apply(sizes);
BENCHMARK(factor_and_solve)->Apply(sizes);

}  // namespace
}  // namespace knot_utm

BENCHMARK_MAIN();
