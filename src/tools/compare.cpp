// Two curves, simulated or measured, beside each other.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "knot_utm/analysis/comparison.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/summary.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#ifdef KNOT_UTM_HAS_ROS
#include "knot_utm/ros/curve_bag.hpp"
#endif
#include "run_python.hpp"
#include "tool.hpp"

namespace knot_utm {
namespace {

constexpr const char* kTool = "compare";

/// How a file that is no curve.csv is to be read, in the words of import_instron.
struct ReadingWords {
  std::string columns, units, specimen, invert, join, rate;
};

struct Arguments {
  std::string a, b;
  bool as_it_is = false;  // raw data, too
  bool overwrite = false;
  bool yaml = false;  // prints all of it
  std::optional<double> tolerance;
  std::optional<std::string> report;  // a folder
  ReadingWords words;
  std::string command;  // the whole line
};

void tell(const std::string& line) { std::fprintf(stderr, "%s: %s\n", kTool, line.c_str()); }

/// The specimen of A or of B. 0: none is given.
int specimen_of(const std::string& text, bool of_b) {
  if (text.empty()) return 0;
  const std::size_t comma = text.find(',');
  const std::optional<double> number =
      parse_number(comma == std::string::npos || !of_b ? text.substr(0, comma) : text.substr(comma + 1));
  constexpr int kMost = 100000;
  if (!number || !(*number >= 1 && *number <= kMost) || *number != std::floor(*number))
    throw InvalidInput("--specimen", text, "a number from 1 on, or one for each file: 1,2");
  return static_cast<int>(*number);
}

/// "--units and --specimen change nothing" of two curves of ours. Empty where none is given. `one_of_many`: a specimen
/// was chosen from a batch or a bag, which that word does change.
std::string without_effect(const ReadingWords& words, bool one_of_many) {
  std::vector<std::string> given;
  if (!words.columns.empty()) given.emplace_back("--columns");
  if (!words.units.empty()) given.emplace_back("--units");
  if (!words.invert.empty()) given.emplace_back("--invert");
  if (!words.specimen.empty() && !one_of_many) given.emplace_back("--specimen");
  return given.empty() ? "" : listed(given, " and ") + (given.size() == 1 ? " changes nothing" : " change nothing");
}

/// As import_instron does, for a bag of measured readings.
void turn_signs(CurveOfFile& curve, const std::string& invert, const Tell& told) {
  for (const auto& [name, value] : {std::pair{"extension", &CurveRow::extension}, std::pair{"load", &CurveRow::load}}) {
    const bool down = falls(curve.rows, value);
    if (invert == name || invert == "both" || (invert == "falling" && down)) {
      for (CurveRow& row : curve.rows) row.*value = -(row.*value);
      told(curve.file + ": the sign of the " + name + " is turned");
    } else if (down && invert.empty()) {
      told(curve.file + ": the " + name + " falls: --invert turns its sign");
    }
  }
}

CurveOfFile read_bag([[maybe_unused]] const std::string& file, [[maybe_unused]] int specimen) {
#ifdef KNOT_UTM_HAS_ROS
  return {file, read_curve_bag(file, specimen)};
#else
  throw InvalidInput::sentence("file", "cannot read a bag: this program was built without ROS").in_file(file);
#endif
}

/// What a testing machine exported, by way of the curve.csv that import_instron makes of it.
CurveOfFile imported(const std::string& file, const ReadingWords& words, int specimen, const Tell& told) {
  struct Folder {
    std::string path = (std::filesystem::temp_directory_path() / "knot_utm_XXXXXX").string();
    ~Folder() {
      std::error_code error;
      std::filesystem::remove_all(path, error);
    }
  } folder;
  if (mkdtemp(folder.path.data()) == nullptr) throw CannotWrite(folder.path);
  const std::string curve = folder.path + "/curve.csv", said = folder.path + "/said";
  std::vector<std::string> with;
  if (!words.columns.empty()) with.push_back("--columns=" + words.columns);
  if (!words.units.empty()) with.push_back("--units=" + words.units);
  if (!words.invert.empty()) with.push_back("--invert=" + words.invert);
  if (!words.rate.empty()) with.push_back("--rate=" + words.rate);
  if (!words.join.empty()) with.emplace_back("--join");
  if (specimen > 0) with.push_back("--specimen=" + std::to_string(specimen));
  with.insert(with.end(), {"--", file, curve});
  const int code = run_python("knot_utm.importing.import_instron", with, said);
  std::ifstream in(said);
  std::string last;
  for (std::string line; std::getline(in, line); last = line)
    if (code == kDone && line.rfind(file + ": ", 0) == 0) told(line);
  if (code == kDone) return {file, read_curve(curve)};
  const std::string name = "import_instron: ";
  const std::string why = last.rfind(name, 0) == 0 ? last.substr(name.size()) : file + ": cannot be imported: " + last;
  if (code == kWrongInput) throw InvalidInput::sentence("file", why);
  throw std::runtime_error(why);
}

bool is_bag(const std::string& file) { return std::filesystem::path(file).extension() == ".bag"; }

bool may_hold_several(const std::string& given) { return std::filesystem::is_directory(given) || is_bag(given); }

CurveOfFile read(const std::string& file, const ReadingWords& words, int specimen, const Tell& told) {
  if (!is_bag(file))
    return is_curve_file(file) ? CurveOfFile{file, read_curve(file)} : imported(file, words, specimen, told);
  CurveOfFile out = read_bag(file, specimen);
  if (!has_its_zero(out.rows)) turn_signs(out, words.invert, told);
  return out;
}

int run(Arguments arguments) {
  if (arguments.tolerance && !std::isfinite(*arguments.tolerance))
    throw InvalidInput("--tolerance", std::to_string(*arguments.tolerance), "a finite number of at least 0");
  const ReadingWords& words = arguments.words;
  if (!words.invert.empty() && words.invert != "falling" && words.invert != "extension" && words.invert != "load" &&
      words.invert != "both")
    throw InvalidInput("--invert", words.invert, "falling, extension, load or both");
  const int of_a = specimen_of(words.specimen, false), of_b = specimen_of(words.specimen, true);
  const std::string unused = without_effect(words, may_hold_several(arguments.a) || may_hold_several(arguments.b));
  arguments.a = curve_file_of(arguments.a, of_a);
  arguments.b = curve_file_of(arguments.b, of_b);
  std::vector<std::string> told;  // nothing of it where there is nothing to compare
  const Tell note = [&](const std::string& line) { told.push_back(line); };
  CurveOfFile first = read(arguments.a, words, of_a, note), second = read(arguments.b, words, of_b, note);
  if (!unused.empty() && has_its_zero(first.rows) && has_its_zero(second.rows))
    note("both curves are of knot_utm, for which " + unused);
  const auto [a, b, comparison] = compare_curves(std::move(first), std::move(second), !arguments.as_it_is, note);
  for (const std::string& line : told) tell(line);
  if (arguments.report && comparison.over_time)
    throw InvalidInput("--report", *arguments.report, "left out: a record without travel has no curve");
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
    app.add_flag(
        "--no-balance", arguments.as_it_is,
        "raw data: take them as they are; else load and extension are zero where the crosshead begins to move");
    app.add_option("--tolerance", arguments.tolerance, "end with exit code 1 where a relative difference is larger [-]")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--report", arguments.report, "a folder to write the page to, report.html and report.pdf");
    app.add_flag("--overwrite", arguments.overwrite,
                 "replace the comparison that the folder holds; else the next free folder is taken, -2, -3, ...");
    app.add_flag("--yaml", arguments.yaml,
                 "print all readings as YAML instead, as comparison.yaml of --report has them");
    app.add_option("--columns", arguments.words.columns,
                   "columns of raw data by name or number: time=NAME,extension=NAME,load=NAME, or one or two of these");
    app.add_option("--units", arguments.words.units,
                   "units of raw data: time=s,extension=in,load=lbf, or one or two of these");
    app.add_flag("--join{yes}", arguments.words.join, "raw data: go on where the crosshead was set to zero");
    app.add_option("--rate", arguments.words.rate, "readings per second of raw data without times");
    app.add_option("--specimen", arguments.words.specimen,
                   "which specimen of raw data, a bag or a batch with several, from 1; N,M for A and B");
    app.add_flag(
        "--invert{falling}", arguments.words.invert,
        "turn the sign of what falls in the pull, or, as --invert=load, --invert=extension or --invert=both, of "
        "these");
    arguments.command = knot_utm::command_line(argc, argv);
    if (const auto code = knot_utm::parse(app, knot_utm::kTool, argc, argv)) return *code;
    return knot_utm::run(arguments);
  });
}
