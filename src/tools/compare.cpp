// Two curves, simulated or measured, beside each other.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "knot_utm/io/cannot_write.hpp"
#include "knot_utm/io/command_hint.hpp"
#include "knot_utm/io/compared_curves.hpp"
#include "knot_utm/io/curve_file.hpp"
#include "knot_utm/io/report.hpp"
#include "knot_utm/io/summary.hpp"
#ifdef KNOT_UTM_HAS_ROS
#include "knot_utm/ros/curve_bag.hpp"
#endif
#include "tool.hpp"

namespace knot_utm {
namespace {

constexpr const char* kTool = "compare";

struct Arguments {
  std::string a, b;
  ZeroWanted zero;
  bool overwrite = false;
  bool yaml = false;  // prints all of it
  std::optional<double> tolerance;
  std::optional<std::string> report;  // a folder
  RawColumns columns;                 // of raw data
  std::string command;                // the whole line
};

void tell(const std::string& line) { std::fprintf(stderr, "%s: %s\n", kTool, line.c_str()); }

CurveOfFile read(const std::string& file, const RawColumns& columns) {
  const std::size_t dot = file.rfind('.');
  if (dot == std::string::npos || file.substr(dot) != ".bag") return {file, read_curve_file(file, columns)};
#ifdef KNOT_UTM_HAS_ROS
  return {file, read_curve_bag(file)};
#else
  throw InvalidInput::sentence("file", file, "cannot read a bag: this program was built without ROS").in_file(file);
#endif
}

int run(const Arguments& arguments) {
  if (arguments.tolerance && !std::isfinite(*arguments.tolerance))
    throw InvalidInput("--tolerance", std::to_string(*arguments.tolerance), "a finite number of at least 0");
  CurveOfFile first = read(arguments.a, arguments.columns), second = read(arguments.b, arguments.columns);
  const auto [a, b, comparison] = compare_curves(std::move(first), std::move(second), arguments.zero, tell);
  const std::string yaml = comparison_yaml(comparison, arguments.a, arguments.b);
  std::string page;
  if (arguments.report) {
    page = write_comparison(*arguments.report, yaml, a, b, arguments.a, arguments.b, arguments.overwrite);
    if (page != *arguments.report)
      tell(*arguments.report + " holds another comparison or page, which stays as it is; this one is written to " +
           page);
  }
  std::fputs(arguments.yaml ? yaml.c_str() : comparison_summary(comparison, arguments.a, arguments.b).c_str(), stdout);
  if (std::fflush(stdout) != 0) throw CannotWrite("standard output");
  std::vector<std::string> beyond;
  if (arguments.tolerance) beyond = beyond_tolerance(comparison, *arguments.tolerance);
  for (const std::string& line : beyond) tell(line);
  if (arguments.report) write_report(page, arguments.command);
  return beyond.empty() ? kDone : kFailed;
}

}  // namespace
}  // namespace knot_utm

int main(int argc, char** argv) {
  return knot_utm::run_tool(knot_utm::kTool, [&] {
    knot_utm::Arguments arguments;
    CLI::App app(
        "Compares two force-extension curves: curve.csv, a bag, or raw data that a testing machine exported. Prints "
        "the "
        "main readings of both and their differences.");
    app.add_option("A", arguments.a, "the curve that B is compared with")->required();
    app.add_option("B", arguments.b, "the other curve")->required();
    CLI::Option* balance = app.add_flag("--balance", arguments.zero.balance,
                                        "raw data: load and extension are zero where the crosshead begins to move");
    app.add_option("--begins-at", arguments.zero.begins_at,
                   "raw data that were cut: extension of their first reading; the load there is taken from the other "
                   "curve [m]")
        ->needs(balance);
    app.add_option("--tolerance", arguments.tolerance, "end with exit code 1 where a relative difference is larger [-]")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--report", arguments.report, "a folder to write the page to, report.html and report.pdf");
    app.add_flag("--overwrite", arguments.overwrite,
                 "write the page over another comparison, instead of to the next free folder, -2, -3, ...");
    app.add_flag("--yaml", arguments.yaml,
                 "print all readings as YAML instead, as comparison.yaml of --report has them");
    std::string columns;
    app.add_option(knot_utm::kColumnsOption, columns, knot_utm::kColumnsHelp);
    arguments.command = knot_utm::command_line(argc, argv);
    if (const auto code = knot_utm::parse(app, knot_utm::kTool, argc, argv)) return *code;
    if (!columns.empty()) arguments.columns = knot_utm::parse_raw_columns(columns, knot_utm::kColumnsOption);
    return knot_utm::run(arguments);
  });
}
