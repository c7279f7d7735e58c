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
#include "knot_utm/io/raw_zero.hpp"
#include "knot_utm/io/report.hpp"
#include "knot_utm/numeric/number.hpp"
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
  std::optional<double> begins_at;  // [m]
  bool overwrite = false;
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

/// One of the two curves.
struct Side {
  std::string file;
  std::vector<CurveRow> rows;
  bool has_zero;  // of its own

  Side(const std::string& file_, const RawColumns& columns)
      : file(file_), rows(read(file_, columns)), has_zero(has_its_zero(rows)) {
    require_finite(rows, file);
    require_readings(pull_of(rows));
  }

  void require_readings(const Pull& pull) const {
    if (pull.size() < 2)
      throw InvalidInput::sentence(
          "pull", std::to_string(pull.size()),
          "the pull has " + std::to_string(pull.size()) + " readings, but must have at least 2")
          .in_file(file);
  }

  /// Says what is done: what raw data do not tell is assumed.
  void balance(const Pull& other) {
    const RawZero zero = zero_at_rest(rows, other);
    const std::string place = format_number(zero.load) + " N at " + format_number(zero.extension) + " m";
    if (zero.readings > 1) {
      note("zero is " + place + ", the mean of its " + std::to_string(zero.readings) +
           " readings before the crosshead moves");
    } else {
      note("the record shows no rest before the pull, so its first reading, " + place +
           ", is taken for zero; if the record was cut, say with --begins-at where it begins");
    }
    rows = balanced(rows, zero);
    require_readings(pull_of(rows));
  }

  void balance_cut(double begins_at, const Pull& other) {
    const std::optional<RawZero> zero = zero_of_cut(rows, begins_at, other);
    if (!zero)
      throw InvalidInput::sentence("--begins-at", format_number(begins_at),
                                   "the other curve has no load at an extension of " + format_number(begins_at) + " m");
    note("the first reading is taken to lie at an extension of " + format_number(begins_at) +
         " m, where its load is set to that of the other curve");
    rows = balanced(rows, *zero);
  }

  void note(const std::string& words) const {
    std::fprintf(stderr, "%s: %s: %s\n", kTool, file.c_str(), words.c_str());
  }
};

/// Raw data alone: a curve of ours has its zero.
void balance(const Arguments& arguments, Side& a, Side& b) {
  if (a.has_zero && b.has_zero)
    std::fprintf(stderr, "%s: --balance changes nothing, since both curves are of knot_utm and have their zero\n",
                 kTool);
  Side& raw = a.has_zero ? b : a;
  const Side& other = a.has_zero ? a : b;
  const Pull beside = other.has_zero ? pull_of(other.rows, ExtensionOf::kMachine) : Pull();
  if (arguments.begins_at) {
    if (a.has_zero == b.has_zero)
      throw InvalidInput::sentence("--begins-at", format_number(*arguments.begins_at),
                                   "one of the curves must be raw data, and the other one a curve of knot_utm");
    return raw.balance_cut(*arguments.begins_at, beside);
  }
  for (Side* side : {&a, &b})
    if (!side->has_zero) side->balance(beside);
}

int run(const Arguments& arguments) {
  if (arguments.tolerance && !std::isfinite(*arguments.tolerance))
    throw InvalidInput("--tolerance", std::to_string(*arguments.tolerance), "a finite number of at least 0");
  Side side_a(arguments.a, arguments.columns), side_b(arguments.b, arguments.columns);
  if (arguments.balance) balance(arguments, side_a, side_b);
  // A machine knows the way of its crosshead alone: beside raw data that is what counts of ours, too.
  const ExtensionOf extension = side_a.has_zero && side_b.has_zero ? ExtensionOf::kSpecimen : ExtensionOf::kMachine;
  const Pull a = pull_of(side_a.rows, extension), b = pull_of(side_b.rows, extension);
  const Comparison comparison = compare(a, b);
  if (!comparison.difference)
    throw InvalidInput::sentence("extensions", "none that both have",
                                 "the curves have no extension in common, so they cannot be compared");
  const std::string yaml = comparison_yaml(comparison, arguments.a, arguments.b);
  std::string page;
  if (arguments.report) {
    page = write_comparison(*arguments.report, yaml, a, b, arguments.a, arguments.b, arguments.overwrite);
    if (page != *arguments.report)
      std::fprintf(stderr, "%s: %s holds another comparison or page, which stays as it is; this one is written to %s\n",
                   kTool, arguments.report->c_str(), page.c_str());
  }
  std::fputs(yaml.c_str(), stdout);
  if (std::fflush(stdout) != 0) throw CannotWrite("standard output");
  std::vector<std::string> beyond;
  if (arguments.tolerance) beyond = beyond_tolerance(comparison, *arguments.tolerance);
  for (const std::string& line : beyond) std::fprintf(stderr, "%s: %s\n", kTool, line.c_str());
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
        "YAML.");
    app.add_option("A", arguments.a, "the curve that B is compared with")->required();
    app.add_option("B", arguments.b, "the other curve")->required();
    CLI::Option* balance = app.add_flag("--balance", arguments.balance,
                                        "raw data: load and extension are zero where the crosshead begins to move");
    app.add_option("--begins-at", arguments.begins_at,
                   "raw data that were cut: extension of their first reading; the load there is taken from the other "
                   "curve [m]")
        ->needs(balance);
    app.add_option("--tolerance", arguments.tolerance, "end with exit code 1 where a relative difference is larger [-]")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--report", arguments.report, "a folder to write the page to, report.html and report.pdf");
    app.add_flag("--overwrite", arguments.overwrite,
                 "write the page over another comparison, instead of to the next free folder, -2, -3, ...");
    std::string columns;
    app.add_option(knot_utm::kColumnsOption, columns, knot_utm::kColumnsHelp);
    arguments.command = knot_utm::command_line(argc, argv);
    if (const auto code = knot_utm::parse(app, knot_utm::kTool, argc, argv)) return *code;
    if (!columns.empty()) arguments.columns = knot_utm::parse_raw_columns(columns, knot_utm::kColumnsOption);
    return knot_utm::run(arguments);
  });
}
