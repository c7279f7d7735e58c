// Two curves, simulated or measured, beside each other.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/raw/comparison.hpp"
#include "knot_utm/raw/raw_zero.hpp"
#include "knot_utm/run/cannot_write.hpp"
#include "knot_utm/run/command_hint.hpp"
#include "knot_utm/run/curve_file.hpp"
#include "knot_utm/run/report.hpp"
#include "knot_utm/run/summary.hpp"
#ifdef KNOT_UTM_HAS_ROS
#include "knot_utm/ros/curve_bag.hpp"
#endif
#include "add_raw_options.hpp"
#include "make_report.hpp"
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
  RecordWords raw;                    // how raw data are read
  std::string command;                // the whole line
};

void tell(const std::string& line) { std::fprintf(stderr, "%s: %s\n", kTool, line.c_str()); }

CurveOfFile read_bag([[maybe_unused]] const RawOptions& options, const std::string& file,
                     [[maybe_unused]] const Tell& told) {
#ifdef KNOT_UTM_HAS_ROS
  CurveOfFile out{file, read_curve_bag(file, options.specimen)};
  if (!has_its_zero(out.rows)) turn_signs(out.rows, options, file, told);
  return out;
#else
  throw InvalidInput::sentence("file", file, "cannot read a bag: this program was built without ROS").in_file(file);
#endif
}

bool is_bag(const std::string& file) { return std::filesystem::path(file).extension() == ".bag"; }

bool may_hold_several(const std::string& given) { return std::filesystem::is_directory(given) || is_bag(given); }

CurveOfFile read(const std::string& file, RawOptions options, const Tell& told) {
  options.needs_time = false;
  if (is_bag(file)) return read_bag(options, file, told);
  return {file, read_curve_file(file, options, told)};
}

int run(Arguments arguments) {
  if (arguments.tolerance && !std::isfinite(*arguments.tolerance))
    throw InvalidInput("--tolerance", std::to_string(*arguments.tolerance), "a finite number of at least 0");
  if (arguments.zero.begins_at && arguments.zero.balance == false)
    throw InvalidInput::sentence(
        "--begins-at", format_number(*arguments.zero.begins_at),
        "--begins-at says where raw data have their zero, so that --no-balance cannot stand beside it");
  const RawOptions of_a = raw_options(arguments.raw, {}, 0, 2), of_b = raw_options(arguments.raw, {}, 1, 2);
  const std::string unused =
      without_effect(arguments.raw, {}, may_hold_several(arguments.a) || may_hold_several(arguments.b));
  arguments.a = curve_file_of(arguments.a, of_a);
  arguments.b = curve_file_of(arguments.b, of_b);
  std::vector<std::string> told;  // nothing of it where there is nothing to compare
  const Tell note = [&](const std::string& line) { told.push_back(line); };
  CurveOfFile first = read(arguments.a, of_a, note), second = read(arguments.b, of_b, note);
  if (!unused.empty() && has_its_zero(first.rows) && has_its_zero(second.rows))
    note("both curves are of knot_utm, for which " + unused);
  const auto [a, b, comparison] = compare_curves(std::move(first), std::move(second), arguments.zero, note);
  for (const std::string& line : told) tell(line);
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
  const bool reported = !arguments.report || make_report(page, arguments.command);
  return beyond.empty() && reported ? kDone : kFailed;
}

}  // namespace
}  // namespace knot_utm

int main(int argc, char** argv) {
  return knot_utm::run_tool(knot_utm::kTool, [&] {
    knot_utm::Arguments arguments;
    CLI::App app(
        "Compares two force-extension curves: the folder of a run, curve.csv, a bag, or raw data that a testing "
        "machine exported. Prints the main readings of both and their differences.");
    app.add_option("A", arguments.a, "the curve that B is compared with")->required();
    app.add_option("B", arguments.b, "the other curve")->required();
    CLI::Option* balance = app.add_flag_callback(
        "--balance", [&arguments] { arguments.zero.balance = true; },
        "raw data: load and extension are zero where the crosshead begins to move; this is so by default");
    app.add_flag_callback(
           "--no-balance", [&arguments] { arguments.zero.balance = false; }, "raw data: take them as they are")
        ->excludes(balance);
    app.add_option("--begins-at", arguments.zero.begins_at,
                   "extension of the first reading of raw data that were cut [m]; the load there is taken from the "
                   "other curve");
    app.add_option("--tolerance", arguments.tolerance, "end with exit code 1 where a relative difference is larger [-]")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--report", arguments.report, "a folder to write the page to, report.html and report.pdf");
    app.add_flag("--overwrite", arguments.overwrite,
                 "replace the comparison that the folder holds; else the next free folder is taken, -2, -3, ...");
    app.add_flag("--yaml", arguments.yaml,
                 "print all readings as YAML instead, as comparison.yaml of --report has them");
    knot_utm::add_raw_options(app, arguments.raw,
                              "which specimen of raw data, a bag or a batch with several, from 1; N,M for A and B");
    arguments.command = knot_utm::command_line(argc, argv);
    if (const auto code = knot_utm::parse(app, knot_utm::kTool, argc, argv)) return *code;
    return knot_utm::run(arguments);
  });
}
