#include "knot_utm/run/summary.hpp"

#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/verdict/result_keys.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {

namespace {

namespace fs = std::filesystem;

/// A unit, and how many of it are one of the unit of result.yaml.
struct ShownUnit {
  std::string name;
  double scale;
};

ShownUnit shown_unit(const std::string& unit, double size) {
  if (unit == "-" || unit == "0 to 1") return {"", 1.0};
  if (unit.rfind("of ", 0) == 0) return {"% " + unit, 100.0};
  const std::string begin = unit.substr(0, unit.find('/')), rest = unit.substr(begin.size());
  if (begin == "m") return size != 0.0 && size < 1e-4 ? ShownUnit{"µm" + rest, 1e6} : ShownUnit{"mm" + rest, 1e3};
  if (begin != "N" && begin != "J") return {unit, 1.0};
  if (size >= 1e3) return {"k" + unit, 1e-3};
  if (size >= 0.1 || size == 0.0) return {unit, 1.0};
  return size >= 1e-4 ? ShownUnit{"m" + unit, 1e3} : ShownUnit{"µ" + unit, 1e6};
}

/// Without a minus before a zero.
std::string with_decimals(double value, int decimals) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", std::max(decimals, 0), value);
  return text.data() + (text[0] == '-' && std::strtod(text.data(), nullptr) == 0.0);
}

/// The place of the last of so many digits, counted behind the point. A 9.97 of two digits is 10.
int decimals_of(double value, int digits) {
  if (value == 0.0) return 0;
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*e", digits - 1, value);
  const char* exponent = std::strchr(text.data(), 'e');
  return exponent ? digits - 1 - std::atoi(exponent + 1) : 0;
}

/// Beside a value an error that is smaller by this much is one of rounding.
constexpr double kRounding = 1e-6;

/// With four digits, or so that the last digit is the second one of the error, which is shown or not.
std::string text_of(double value, const std::string& unit, double error, bool with_error) {
  constexpr int kMost = 9;  // behind the point; a value below that is written with an exponent
  const ShownUnit shown = shown_unit(unit, std::abs(value));
  value *= shown.scale;
  error *= shown.scale;
  const bool known = error > kRounding * std::abs(value);
  const int decimals = known ? decimals_of(error, 2) : decimals_of(value, 4);
  const bool plain = std::isfinite(value) && decimals <= kMost;
  std::string text = plain ? with_decimals(value, decimals) : short_number(value);
  if (plain && known && with_error) text += " ± " + with_decimals(error, decimals);
  return shown.name.empty() ? text : text + " " + shown.name;
}

/// A line that begins with the name of a reading.
std::string line_of(const std::string& label, const std::string& words) {
  constexpr std::size_t kColumn = 22;
  return "  " + label + std::string(label.size() < kColumn ? kColumn - label.size() : 1, ' ') + words + "\n";
}

/// A reading of the summary. `error`: the key of its error, empty where it has none.
struct SummaryRow {
  const char* key;
  const char* label;
  const char* error;
};

/// In this order, as many as there are and as fit.
constexpr SummaryRow kRows[] = {
    {"jump_force", "knot jumped open at", ""},
    {"plateau_force", "plateau force", "plateau_force_error"},
    {"lock_extension", "lock extension", "lock_extension_error"},
    {"locked_stiffness", "locked stiffness", "locked_stiffness_error"},
    {"force_ratio", "force ratio", ""},
    {"peak_force", "largest load", "peak_force_error"},
    {"final_excess_length", "rod in the knot", ""},
    {"break_extension", "extension at break", ""},
    {"elongation_at_break", "elongation at break", ""},
    {"relaxation", "relaxation", ""},
    {"hysteresis", "hysteresis", ""},
    {"knotability", "knotability", ""},
};
constexpr std::size_t kMostRows = 6;

/// A file that a run wrote.
class ResultFile {
 public:
  explicit ResultFile(const std::string& file) {
    try {
      root_ = YAML::Load(read_input(file));
    } catch (const YAML::Exception& error) {
      throw InvalidInput::sentence("file", shown(file) + " is not the result of a run: " + shown(error.msg));
    }
    if (!root_.IsMap()) throw InvalidInput::sentence("file", shown(file) + " is not the result of a run");
  }

  std::string word(const std::string& key) const { return word_in(root_[key]); }
  std::optional<double> number(const std::string& key) const { return parse_number(word(key)); }
  std::size_t count(const std::string& key) const {
    const YAML::Node list = root_[key];
    return list.IsDefined() && list.IsSequence() ? list.size() : 0;
  }
  /// One of the statistics of a reading.
  std::optional<double> statistic(const std::string& key, const char* which) const {
    const YAML::Node of = root_[key];
    return of.IsDefined() && of.IsMap() ? parse_number(word_in(of[which])) : std::nullopt;
  }

 private:
  /// Of a list of one: that one.
  static std::string word_in(const YAML::Node& node) {
    if (node && node.IsSequence() && node.size() == 1) return word_in(node[0]);
    return node && node.IsScalar() ? node.Scalar() : "";
  }
  YAML::Node root_;
};

std::string unit_of(const std::string& key) {
  const ResultKey* found = result_key(key);
  return found ? found->unit : "-";
}

/// What belongs to a reading and is no error.
std::string beside(const std::string& key, const ResultFile& result, double error) {
  const auto reading = [&](const char* of) {
    return text_of(result.number(of).value_or(NAN), unit_of(of), error, false);
  };
  if (key == "plateau_force" && result.number("plateau_force_low") && result.number("plateau_force_high"))
    return ", between " + reading("plateau_force_low") + " and " + reading("plateau_force_high");
  if (key == "jump_force" && result.number("jump_extension"))
    return " and an extension of " + reading("jump_extension");
  return "";
}

std::string run_lines(const ResultFile& result) {
  std::string out = "the test ended by " + result.word("ended_by");
  const std::optional<double> time = result.number("simulated_time"), factor = result.number("real_time_factor");
  if (time && factor)
    out += " after " + with_decimals(*time, 1) + " s, at " + with_decimals(*factor, 1) + " times real time";
  out += "\n";
  const std::string pattern = result.word("motion_pattern");
  const std::optional<double> confidence = result.number("motion_pattern_confidence");
  if (pattern != "none" && confidence)
    out += line_of("motion pattern", pattern + " (confidence " + with_decimals(*confidence, 2) + ")");
  std::size_t rows = 0;
  for (const SummaryRow& row : kRows) {
    const std::optional<double> value = result.number(row.key);
    // Nobody misses a plateau of a rod without two knots.
    const bool missed = std::string(row.key) == "plateau_force" && (pattern != "none" || result.number("jump_force"));
    const std::string none = missed ? result.word("no_plateau_because") : "";
    if (!value && (none.empty() || none == "null")) continue;
    if (rows++ == kMostRows) break;
    const double error = result.number(row.error).value_or(0.0);
    out += line_of(row.label, value ? reading_text(*value, unit_of(row.key), error) + beside(row.key, result, error)
                                    : "none: " + none);
  }
  const std::string passed = result.word("specification_passed");
  if (passed == "true" || passed == "false")
    out += line_of("specification",
                   passed == "true"
                       ? "met"
                       : "not met in " + std::to_string(result.count("specification_failed")) + " of its requirements");
  return out;
}

std::string batch_lines(const ResultFile& result) {
  const double all = result.number("specimens").value_or(0.0);
  const auto rejected = static_cast<double>(result.count("rejected"));
  std::string out = with_decimals(all - rejected, 0) + " of " + with_decimals(all, 0) + " specimens count\n";
  std::size_t rows = 0;
  for (const SummaryRow& row : kRows) {
    const std::optional<double> mean = result.statistic(row.key, "mean"), sd = result.statistic(row.key, "sd");
    if (!mean) continue;
    if (rows++ == kMostRows) break;
    const double n = result.statistic(row.key, "n").value_or(0.0);
    out += line_of(row.label, reading_text(*mean, unit_of(row.key), sd.value_or(0.0)) + " (mean" +
                                  (sd ? " ± standard deviation" : "") + " of " + with_decimals(n, 0) + ")");
  }
  return out;
}

/// A reading of both curves. Empty: neither has it.
std::string compared(const char* label, const std::optional<double>& a, const std::optional<double>& b,
                     const std::string& unit) {
  if (!a && !b) return "";
  constexpr std::size_t kColumn = 16;
  const auto cell = [&](const std::optional<double>& value) {
    std::string text = value ? reading_text(*value, unit) : "none";
    if (text.size() < kColumn) text.append(kColumn - text.size(), ' ');
    return text;
  };
  std::string change = "-";
  if (a && b && *a != 0.0) {
    const double percent = 100.0 * (*b - *a) / std::abs(*a);
    change = (percent >= 0.05 ? "+" : "") + with_decimals(percent, std::abs(percent) < 10.0 ? 1 : 0) + " %";
  }
  return line_of(label, cell(a) + cell(b) + change);
}

constexpr std::array<const char*, 5> kOfComparison{"comparison.yaml", "a.csv", "b.csv", "report.html", "report.pdf"};

/// Whether something stands in the folder that a comparison would write over, but for the very same comparison, or a
/// run, whose page it would take.
bool holds_another(const fs::path& folder, const std::string& yaml) {
  std::error_code error;
  const fs::path before = folder / kOfComparison.front();
  if (fs::is_regular_file(before, error)) return read_whole(before.string()) != yaml;
  for (const char* name :
       {"a.csv", "b.csv", "report.html", "report.pdf", "result.yaml", "statistics.yaml", "samples.csv"})
    if (fs::is_regular_file(folder / name, error)) return true;
  return false;
}

void require_room_for_comparison(const std::string& folder, const std::string& file_a, const std::string& file_b) {
  const fs::path where(folder);
  std::error_code error;
  if (fs::exists(where / "result.yaml", error))
    throw InvalidInput::sentence(
        "--report",
        "the folder " + shown(folder) + " holds a run: choose another folder for the report of the comparison");
  for (const char* name : kOfComparison) {
    for (const std::string& compared : {file_a, file_b}) {
      if (fs::equivalent(where / name, compared, error))
        throw InvalidInput::sentence("--report", "the report would write over " + shown((where / name).string()) +
                                                     ", which is compared: choose another folder");
    }
  }
}

std::string pull_csv(const Pull& pull) {
  std::string text = "extension,load\nm,N\n";
  for (const PullPoint& point : pull) text += format_number(point.extension) + "," + format_number(point.force) + "\n";
  return text;
}

}  // namespace

std::string reading_text(double value, const std::string& unit, double error) {
  return text_of(value, unit, error, true);
}

std::string run_summary(const std::string& folder) {
  const fs::path batch = fs::path(folder) / "statistics.yaml";
  std::error_code error;
  if (fs::is_regular_file(batch, error)) return batch_lines(ResultFile(batch.string()));
  return run_lines(ResultFile((fs::path(folder) / "result.yaml").string()));
}

std::string comparison_summary(const Comparison& comparison, const std::string& file_a, const std::string& file_b) {
  const CurveReadings &a = comparison.a, &b = comparison.b;
  std::string out = "A is " + shown(file_a) + ", B is " + shown(file_b) + "\n";
  out += line_of("", "A               B               B - A");
  out += compared("plateau force", a.plateau_force, b.plateau_force, "N");
  out += compared("breakaway force", a.breakaway_force, b.breakaway_force, "N");
  out += compared("knot jumped open at", a.jump_force, b.jump_force, "N");
  out += compared("lock, by the load", a.lock_extension_by_load, b.lock_extension_by_load, "m");
  out += compared("locked stiffness", a.locked_stiffness, b.locked_stiffness, "N/m");
  out += compared("largest load", a.peak_force, b.peak_force, "N");
  if (comparison.over_time) out += compared("largest slip", a.largest_drop, b.largest_drop, "N");
  if (!comparison.difference) return out;
  const CurveDifference& d = *comparison.difference;
  const std::string share = d.load > 0.0 ? " (" + with_decimals(100.0 * d.rms / d.load, 2) + " % of A's largest)" : "";
  const auto apart = [&](double force) { return reading_text(force < kRounding * d.load ? 0.0 : force, "N"); };
  out += "from " + reading_text(d.common.low, "m") + " to " + reading_text(d.common.high, "m") +
         ", which both have, the loads differ by " + apart(d.rms) + share + " RMS, at most by " +
         apart(std::abs(d.largest)) + " at " + reading_text(d.largest_at, "m") + "\n";
  return out;
}

ProgressLine::ProgressLine(std::FILE* out) : out_(out && isatty(fileno(out)) != 0 ? out : nullptr) {}

void ProgressLine::show(const Sample& sample, const ProgramRunner& program, double wall_time) {
  if (!out_ || wall_time < next_) return;
  next_ = wall_time + 0.2;
  shown_ = true;
  const double factor = sample.time / wall_time;
  const double left = factor > 0.0 ? program.time_left() / factor : 0.0;
  std::fprintf(out_, "\r%-8s %5.1f %%  s %7s mm  load %9.4g N  %5.1f x real time  %4.0f s left",
               phase_name(sample.phase), 100.0 * program.progress(), with_decimals(1e3 * sample.extension, 2).c_str(),
               sample.load + 0.0, factor, left);
  std::fflush(out_);
}

void ProgressLine::show(int ended, int count) {
  if (!out_) return;
  shown_ = true;
  const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  std::fprintf(out_, "\r%d of %d specimens tested  %5.0f s left ", ended, count, passed / ended * (count - ended));
  std::fflush(out_);
}

void ProgressLine::end() {
  if (shown_) std::fputc('\n', out_);
  shown_ = false;
}

std::string write_comparison(const std::string& asked, const std::string& yaml, const Pull& a, const Pull& b,
                             const std::string& file_a, const std::string& file_b, bool overwrite) {
  require_room_for_comparison(asked, file_a, file_b);
  std::string folder = asked;
  for (int number = 2; !overwrite && holds_another(folder, yaml); ++number) folder = numbered_folder(asked, number);
  require_room_for_comparison(folder, file_a, file_b);
  const fs::path where(folder);
  make_folder(folder, "--report");
  const std::array<std::string, 3> texts{yaml, pull_csv(a), pull_csv(b)};
  for (std::size_t i = 0; i < texts.size(); ++i) write_whole((where / kOfComparison[i]).string(), texts[i]);
  return folder;
}

}  // namespace knot_utm
