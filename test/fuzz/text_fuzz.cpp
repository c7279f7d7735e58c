// Parsers of texts: methods, files of materials and load cells, centrelines, curves, single words.
#include <cmath>
#include <sstream>
#include <vector>

#include "fuzz/memory_file.hpp"
#include "fuzz/target.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/program.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/centreline_file.hpp"
#include "knot_utm/specimen/polyline.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {

namespace {

/// A method's text, and the --set of a command line: whatever follows a line "--set" is one override a line.
void fuzz_method(const std::string& text) {
  const std::string mark = "\n--set\n";
  const std::size_t end = text.find(mark);
  std::vector<std::string> overrides;
  for (std::size_t from = end; from != std::string::npos && overrides.size() < 16;) {
    from += from == end ? mark.size() : 1;
    const std::size_t to = text.find('\n', from);
    overrides.push_back(text.substr(from, to == std::string::npos ? to : to - from));
    from = to;
  }
  const Method method = parse_method(text.substr(0, end), "fuzz.yaml", overrides);
  check_method(method);

  // What was understood can be written, and means the same when read again.
  const std::string written = method_yaml(method);
  try {
    promise(method_yaml(parse_method(written, "fuzz.yaml")) == written, "a resolved method reads back to the same");
  } catch (const InvalidInput& refused) {
    std::fprintf(stderr, "%s\n%s", refused.what(), written.c_str());
    promise(false, "a resolved method is one that can be read");
  }
}
const FuzzTarget method("method", fuzz_method);

void fuzz_material(const std::string& text) {
  const MemoryFile file(text);
  const Material material =
      parse_method("{material: " + file.name() + ", program: [{hold: {duration: 1}}]}", "fuzz.yaml").material;
  promise(material.radius >= 1e-5 && material.radius <= 0.05, "a radius in its range");
  promise(material.bending_stiffness > 0.0 && material.stretching_stiffness > 0.0, "stiffnesses above zero");
  promise(!material.name.empty(), "a material has a name");
}
const FuzzTarget material("material", fuzz_material);

void fuzz_load_cell(const std::string& text) {
  const MemoryFile file(text);
  const Method tested = parse_method(
      "{material: nylon, machine: {load_cell: " + file.name() + "}, program: [{hold: {duration: 1}}]}", "fuzz.yaml");
  const LoadCellOptions& cell = tested.machine.load_cell;
  promise(cell.capacity > 0.0 && cell.resolution < cell.capacity, "a resolution below the capacity");
  promise(cell.sampling_rate >= 1e-2 && cell.sampling_rate <= 1e4, "a sampling rate in its range");
  promise(!cell.name.empty(), "a load cell has a name");
}
const FuzzTarget load_cell("load_cell", fuzz_load_cell);

/// The points of a specimen (specimen.file), and the rod that is made of them.
void fuzz_centreline(const std::string& text) {
  std::istringstream in(text);
  const Points points = read_centreline(in, "fuzz.csv");
  promise(points.cols() >= 4 && points.allFinite(), "four finite points or more");

  constexpr double kRadius = 0.1, kEdge = 0.15;
  // Each edge is held against each other one: what is long, but not too long, would take seconds here.
  const double length = arclengths(points).back();
  if (length > 500.0 * kEdge && length < 1e5 * kEdge) return;
  const Centreline rod = from_points(points, kRadius, kEdge);
  promise(rod.points.allFinite(), "a rod of finite nodes");
  promise(rod.points.leftCols(1) == points.leftCols(1) && rod.points.rightCols(1) == points.rightCols(1),
          "a rod that ends where its points do");
  const Eigen::Index edges = rod.points.cols() - 1;
  const double longest = (rod.points.rightCols(edges) - rod.points.leftCols(edges)).colwise().norm().maxCoeff();
  promise(longest < 2.0 * kEdge, "edges about as long as was asked for");
}
const FuzzTarget centreline("centreline", fuzz_centreline);

/// curve.csv, as `compare` and others read it.
void fuzz_curve(const std::string& text) {
  std::istringstream in(text);
  for (const CurveRow& row : read_curve(in, "curve.csv"))
    promise(phase_named(phase_name(row.phase)) == row.phase, "a phase that has a name");
}
const FuzzTarget curve("curve", fuzz_curve);

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// A number, and the name of a phase.
void fuzz_word(const std::string& text) {
  if (const std::optional<double> value = parse_number(text)) {
    promise(same(parse_number(format_number(*value)).value(), *value), "a number reads back to the same");
    promise(same(parse_number(format_yaml_number(*value)).value(), *value), "and so it does as YAML");
    const std::string sign = text.substr(0, 1) == "+" || text.substr(0, 1) == "-" ? text.substr(1) : text;
    promise(sign.find_first_of("+-") != 0, "a number has one sign");
  }
  if (const std::optional<Phase> phase = phase_named(text)) promise(phase_name(*phase) == text, "a phase has one name");
}
const FuzzTarget word("word", fuzz_word);

}  // namespace

}  // namespace knot_utm
