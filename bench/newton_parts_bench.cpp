// The parts of one Newton iteration, for rods of 250 to 4000 nodes: the residual (elastic and contact forces), the
// assembly (elastic blocks and contacts into the matrix) and factor and solve (with the elastic assembly, which the
// factorisation in place has to repeat).
//
// The rod is straight but for its first third, a coil whose turns lie on each other, so that about as much of it is in
// contact as in a tightened fisherman's loop. Times are of one call; items are nodes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/sim/centreline_terms.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/sim/step_matrix.hpp"
#include "knot_utm/specimen/material.hpp"

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
  RodState state;  // at `start`
  Boundary free;

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
    state.position = start;
  }

  StepStart step() const { return {state, free, kDt}; }

  int nodes() const { return static_cast<int>(position.cols()); }

  SmoothContact contact() const {
    const MemoryFriction friction{0.6, 2e-3 * kRadius};
    return {rod, NormalLaw{1e10, 0.05 * kRadius}, friction, 0.5 * kRadius};
  }
};

void per_node(benchmark::State& state) { state.SetItemsProcessed(state.iterations() * state.range(0)); }

void residual_elastic(benchmark::State& state) {
  const Specimen specimen(static_cast<int>(state.range(0)));
  CentrelineTerms centreline(specimen.rod, true);
  std::vector<Lanes> force(at(specimen.nodes()));
  for (auto _ : state) {
    std::fill(force.begin(), force.end(), Lanes{0.0, 0.0, 0.0, 0.0});
    centreline.add_forces(specimen.step(), specimen.position, force);
    benchmark::DoNotOptimize(force.data());
  }
  per_node(state);
}

void residual_contact(benchmark::State& state) {
  const Specimen specimen(static_cast<int>(state.range(0)));
  SmoothContact contact = specimen.contact();
  contact.begin(specimen.position);
  for (auto _ : state) {
    contact.evaluate(specimen.position, specimen.start, kDt);
    benchmark::DoNotOptimize(contact.contacts().data());
  }
  state.counters["contacts"] = static_cast<double>(contact.contacts().size());
  per_node(state);
}

/// A specimen whose contacts and forces are known, and a matrix with room for them.
struct Evaluated {
  Specimen specimen;
  SmoothContact contact = specimen.contact();
  CentrelineTerms centreline{specimen.rod, true};
  StepMatrix<3> matrix{specimen.nodes()};
  std::vector<double> diagonal = std::vector<double>(at(specimen.nodes()), 1e3);

  explicit Evaluated(const benchmark::State& state) : specimen(static_cast<int>(state.range(0))) {
    contact.begin(specimen.position);
    contact.evaluate(specimen.position, specimen.start, kDt);
    std::vector<Lanes> force(at(specimen.nodes()));
    centreline.add_forces(specimen.step(), specimen.position, force);
    matrix.locate(contact.contacts());
    matrix.set_zero_beyond_band();
    centreline.set_stiffness(diagonal, matrix);
  }
};

void assembly_elastic(benchmark::State& state) {
  Evaluated scene(state);
  for (auto _ : state) {
    scene.matrix.set_zero_beyond_band();
    scene.centreline.set_stiffness(scene.diagonal, scene.matrix);
    benchmark::ClobberMemory();
  }
  per_node(state);
}

void assembly_contact(benchmark::State& state) {
  Evaluated scene(state);
  std::size_t active = 0;
  std::vector<ContactModel> models;
  for (auto _ : state) {
    scene.matrix.locate(scene.contact.contacts());
    scene.contact.linearise({}, kDt, models);
    active = 0;
    for (const ContactPoint& point : scene.contact.contacts()) {
      if (!point.active()) continue;
      scene.matrix.add(point, models[active], active);
      ++active;
    }
    benchmark::ClobberMemory();
  }
  state.counters["active"] = static_cast<double>(active);
  per_node(state);
}

void factor_and_solve(benchmark::State& state) {
  Evaluated scene(state);
  BlockMatrix<3>& matrix = scene.matrix.values();
  BlockMatrix<3>::Vector x(at(scene.specimen.nodes()));
  for (auto _ : state) {
    // The values do not matter to the time.
    scene.matrix.set_zero_beyond_band();
    scene.centreline.set_stiffness(scene.diagonal, scene.matrix);
    x.assign(at(scene.specimen.nodes()), Lanes{1.0, 1.0, 1.0, 0.0});
    if (!matrix.solve(x)) return state.SkipWithError("singular");
    benchmark::DoNotOptimize(x.data());
  }
  state.counters["blocks"] = matrix.pattern().blocks();
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
