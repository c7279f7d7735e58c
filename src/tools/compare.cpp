// Two curves, simulated or measured, beside each other.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/analysis/curve_difference.hpp"
#include "knot_utm/io/cannot_write.hpp"
#include "knot_utm/io/comparison.hpp"
#include "knot_utm/io/curve_file.hpp"
#include "knot_utm/io/report.hpp"
#ifdef KNOT_UTM_HAS_ROS
#include "knot_utm/ros/curve_bag.hpp"
#endif
#include "tool.hpp"

namespace knot_utm {
namespace {

constexpr const char* kTool = "compare";

struct Arguments {
  std::string a, b;
  bool balance = false;
  std::optional<double> tolerance;
  std::optional<std::string> report;  // a folder
  RawColumns columns;                 // of raw data
  std::string command;                // the whole line
};

std::vector<CurveRow> read(const std::string& file, const RawColumns& columns) {
  const std::size_t dot = file.rfind('.');
  if (dot == std::string::npos || file.substr(dot) != ".bag") return read_curve_file(file, columns);
#ifdef KNOT_UTM_HAS_ROS
  return read_curve_bag(file);
#else
  throw InvalidInput::sentence("file", file, "cannot read a bag: this program was built without ROS").in_file(file);
#endif
}

void require_finite(const std::vector<CurveRow>& rows, const std::string& file) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CurveRow& row = rows[i];
    if (pulls(row.phase) && !(std::isfinite(row.time) && std::isfinite(row.extension) && std::isfinite(row.load)))
      throw InvalidInput::sentence("reading", std::to_string(i + 1),
                                   "reading " + std::to_string(i + 1) + " has no time, no extension or no load")
          .in_file(file);
  }
}

Pull pull_from(const std::string& file, const RawColumns& columns, bool balanced) {
  const std::vector<CurveRow> rows = read(file, columns);
  require_finite(rows, file);
  Pull pull = pull_of(rows, balanced);
  if (pull.size() < 2)
    throw InvalidInput::sentence("pull", std::to_string(pull.size()),
                                 "the pull has " + std::to_string(pull.size()) + " readings, but must have at least 2")
        .in_file(file);
  return pull;
}

int run(const Arguments& arguments) {
  if (arguments.tolerance && !std::isfinite(*arguments.tolerance))
    throw InvalidInput("--tolerance", std::to_string(*arguments.tolerance), "a finite number of at least 0");
  const Pull a = pull_from(arguments.a, arguments.columns, arguments.balance);
  const Pull b = pull_from(arguments.b, arguments.columns, arguments.balance);
  const Comparison comparison = compare(a, b);
  if (!comparison.difference)
    throw InvalidInput::sentence("extensions", "none that both have",
                                 "the curves have no extension in common, so they cannot be compared");
  const std::string yaml = comparison_yaml(comparison, arguments.a, arguments.b);
  if (arguments.report) write_comparison(*arguments.report, yaml, a, b, arguments.a, arguments.b);
  std::fputs(yaml.c_str(), stdout);
  if (std::fflush(stdout) != 0) throw CannotWrite("standard output");
  std::vector<std::string> beyond;
  if (arguments.tolerance) beyond = beyond_tolerance(comparison, *arguments.tolerance);
  for (const std::string& line : beyond) std::fprintf(stderr, "%s: %s\n", kTool, line.c_str());
  if (arguments.report) write_report(*arguments.report, arguments.command);
  return beyond.empty() ? kDone : kFailed;
}

}  // namespace
}  // namespace knot_utm

int main(int argc, char** argv) {
  return knot_utm::run_tool(knot_utm::kTool, [&] {
    knot_utm::Arguments arguments;
    CLI::App app(
        "Compares two force-extension curves: curve.csv, a bag, or raw data that a testing machine exported. Prints "
        "YAML.");
    app.add_option("A", arguments.a, "the curve that B is held against")->required();
    app.add_option("B", arguments.b, "the other curve")->required();
    app.add_flag("--balance", arguments.balance, "the first load and extension of each pull are its zeros");
    app.add_option("--tolerance", arguments.tolerance, "exit code 1 where a relative difference is larger [-]")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--report", arguments.report, "a folder to write a page to: report.html and report.pdf");
    std::string columns;
    app.add_option(knot_utm::kColumnsOption, columns, knot_utm::kColumnsHelp);
    arguments.command = knot_utm::command_line(argc, argv);
    if (const auto code = knot_utm::parse(app, knot_utm::kTool, argc, argv)) return *code;
    if (!columns.empty()) arguments.columns = knot_utm::parse_raw_columns(columns, knot_utm::kColumnsOption);
    return knot_utm::run(arguments);
  });
}
