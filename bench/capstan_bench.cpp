// One rod sliding round a roller: what it costs and how far its tension ratio is from the elastic capstan law.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>
#include <exception>
#include <map>
#include <string>

#include "sim/capstan.hpp"

namespace {

int run(double load, const knot_utm::Capstan::Options& options) {
  const std::clock_t start = std::clock();
  knot_utm::Capstan scene(load, options);
  const double ratio = scene.ratio();
  const double cpu_time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const double law = knot_utm::elastic_capstan(load, knot_utm::Capstan::kMu, 2.0 * M_PI);
  std::printf("cpu_time: %.6g\nsimulated_time: %.17g\nratio: %.17g\nlaw: %.17g\n", cpu_time, scene.time, ratio, law);
  std::printf("nodes: %d\nsteps: %llu\nnewton_iterations: %llu\n", scene.last + 1,
              static_cast<unsigned long long>(scene.counters.steps),
              static_cast<unsigned long long>(scene.counters.iterations));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A rod slides round a roller by its radius. Lengths are in radii of the roller, forces in B/radius^2.");
  knot_utm::Capstan::Options options;
  double load = 10.0;
  const std::map<std::string, bool> laws = {{"memory", false}, {"smoothed", true}};
  app.add_option("--load", load, "T1 on the slack side")->check(CLI::PositiveNumber);
  app.add_option("--edges", options.edges_a_turn, "edges a turn")->check(CLI::Range(12, 4096));
  app.add_option("--strides", options.strides_an_edge, "time steps an edge")->check(CLI::Range(1, 1000));
  app.add_option("--residual", options.residual, "of T1")->check(CLI::PositiveNumber);
  app.add_option("--contact-tolerance", options.contact_tolerance)->check(CLI::PositiveNumber);
  app.add_option("--presliding", options.presliding)->check(CLI::PositiveNumber);
  app.add_option("--friction", options.smoothed, "memory or smoothed")->transform(CLI::CheckedTransformer(laws));
  try {
    app.parse(argc, argv);
    return run(load, options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "capstan_bench: %s\n", error.what());
    return 1;
  }
}
