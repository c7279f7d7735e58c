// Tries a saved time step again, and tells what happens.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/sim/saved_step.hpp"
#include "tool.hpp"

namespace knot_utm {
namespace {

constexpr const char* kTool = "replay_step";

void print_scene(const SavedStep& step) {
  const RodProperties& rod = step.stepper->rod();
  const StepSettings& settings = step.stepper->settings();
  const Boundary& boundary = step.boundary;
  std::printf("rod of %td nodes, %g m, radius %g m%s\n", rod.nodes(), rod.length(), rod.material.radius,
              step.stepper->state().twist.size() > 0 ? ", with twist" : "");
  std::printf("contact %s, friction %s, %g\n", settings.contact_law == ContactLaw::kEdge ? "edge" : "smooth",
              settings.friction.name(), settings.friction.coefficient());
  std::printf("%zu held nodes, %zu held edges, %zu rollers, %zu grips, %zu forces\n", boundary.fixed_nodes.size(),
              boundary.fixed_twists.size(), boundary.rollers.size(), boundary.grips.size(), boundary.forces.size());
  std::printf("step of %g s from t = %.9g s, at most %d iterations\n\n", step.dt, step.time, settings.max_iterations);
}

/// A row an iterate: the contact that is named is the deepest one, by its arclengths or by its roller.
class Table {
 public:
  Table() {
    std::printf("%4s %12s %12s %9s %6s %12s %6s %8s %12s  %s\n", "", "residual [N]", "tolerance", "at node", "factor",
                "moved [m]", "active", "touching", "overlap [m]", "of [m], [m]");
  }
  void add(const Iterate& i) {
    // A prediction comes of no change.
    if (i.factor == 0.0 && row_ > 0) {
      std::printf("once more, friction linearised by secants and tangents in turn\n");
      row_ = 0;
    }
    std::printf("%4d %12.5e %12.5e %8d%s %6.3f %12.5e %6d %8d ", row_++, i.residual, i.tolerance, i.node,
                i.spin ? "t" : " ", i.factor, i.motion, i.active, i.touching);
    if (!i.in_contact)
      std::printf("%12s\n", "-");
    else if (i.roller >= 0)
      std::printf("%12.5e  %.5f, roller %d\n", i.overlap, i.arclengths[0], i.roller);
    else
      std::printf("%12.5e  %.5f, %.5f\n", i.overlap, i.arclengths[0], i.arclengths[1]);
  }

 private:
  int row_ = 0;
};

int run(const std::string& file) {
  SavedStep step = load_step(read_input(file), file);
  print_scene(step);
  Table table;
  step.stepper->watch([&](const Iterate& iterate) { table.add(iterate); });
  const StepSummary summary = step.try_again();
  std::printf("\n%d iterations, residual %g N, tolerance %g N", summary.newton.iterations, summary.newton.residual,
              summary.newton.tolerance);
  if (summary.newton.converged())
    std::printf("; largest motion %g m, largest overlap %g m", summary.largest_motion, summary.largest_overlap);
  std::printf("\n%s%s\n", summary.accepted() ? "accepted" : "not accepted: ", summary.reason.c_str());
  if (!summary.accepted()) std::printf("%s\n", summary.diagnosis.text().c_str());
  return summary.accepted() ? kDone : kFailed;
}

/// Reads the command line; an exit code where that is all there is to do.
std::optional<int> read_arguments(int argc, char** argv, std::string& file) {
  CLI::App app(
      "Tries a saved time step again, and prints each iteration. The exit code is 0 where the step was accepted, 1 "
      "where it was not, and 2 where the file is wrong.");
  app.add_option("FILE", file, "a time step that tensile_test saved, failed_step.bin")->required();
  return parse(app, kTool, argc, argv);
}

}  // namespace
}  // namespace knot_utm

int main(int argc, char** argv) {
  return knot_utm::run_tool(knot_utm::kTool, [&] {
    std::string file;
    if (const std::optional<int> code = knot_utm::read_arguments(argc, argv, file)) return *code;
    return knot_utm::run(file);
  });
}
