// A plank that is dragged over a log: where the two rods are before and after, and how far they have turned.
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "knot_utm/rod/rod.hpp"
#include "sim/rolling_log.hpp"

namespace {

/// A row for each node, its place in radii. `mark`: the direction that pointed upwards from the centreline before the
/// plank was dragged.
void print(const char* scene, const knot_utm::RollingLog& log, const knot_utm::RodState& before) {
  const knot_utm::RodState& now = log.stepper->state();
  const knot_utm::Points tangents = knot_utm::tangents(now.position), were = knot_utm::tangents(before.position);
  for (int i = 0; i < log.nodes(); ++i) {
    const bool of_log = i <= knot_utm::RollingLog::kLog;
    const int last = of_log ? knot_utm::RollingLog::kLog - 1 : log.nodes() - 2;
    const int edge = std::min(i, last);
    const knot_utm::Directors then =
        knot_utm::material_directors(were.col(edge), before.reference_director.col(edge), before.twist[edge]);
    const double up = std::atan2(then.m2[2], then.m1[2]);
    const knot_utm::Vec3 mark =
        knot_utm::material_directors(tangents.col(edge), now.reference_director.col(edge), now.twist[edge] + up).m1;
    const knot_utm::Vec3 place = now.position.col(i) / log.material.radius;
    std::printf("%s,%s,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", scene, of_log ? "log" : "plank", place[0], place[1], place[2],
                mark[0], mark[1], mark[2]);
  }
}

int run(double way) {
  std::printf("scene,rod,x,y,z,mark_x,mark_y,mark_z\n");
  for (const bool at_surface : {true, false}) {
    knot_utm::RollingLog log(at_surface ? 1.0 : 0.0);
    const knot_utm::RodState before = log.stepper->state();
    if (at_surface) print("before", log, before);
    const double h = log.material.radius, from = log.moved();
    log.drag(way * h);
    print(at_surface ? "surface" : "centreline", log, before);
    std::fprintf(stderr, "%s: the plank went %.4g h, the log %.4g h and turned by %.4g\n",
                 at_surface ? "surface" : "centreline", way, (log.moved() - from) / h, log.turned());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "A plank is dragged over a log, with friction at the surfaces and on the centrelines. Prints both as CSV.");
  double way = 2.5;
  app.add_option("--way", way, "of the plank, in radii")->check(CLI::Range(0.0, 6.0));
  try {
    app.parse(argc, argv);
    return run(way);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rolling_bench: %s\n", error.what());
    return 1;
  }
}
