#include "knot_utm/io/run_writer.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "knot_utm/io/number.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

/// Whole or not at all, so that a file that is there can be trusted.
void write_text(const fs::path& file, const std::string& text) {
  const fs::path part = file.string() + ".part";
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  std::error_code error;
  if (out) fs::rename(part, file, error);
  if (!out || error) throw std::runtime_error(file.string() + ": cannot be written");
}

std::string make_folder(const std::string& folder, const Method& method) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder, error)) throw InvalidInput("--out", folder, "a folder that can be made");
  for (const char* old : {"result.yaml", "final_shape.csv", "test.bag"}) fs::remove(fs::path(folder) / old, error);

  Method own = method;
  if (own.specimen.knot == KnotKind::kFile) {
    const fs::path copy = fs::path(folder) / "specimen.csv";
    // A run repeated from its own folder reads this very file.
    if (!fs::equivalent(own.specimen.file, copy, error)) {
      fs::copy_file(own.specimen.file, copy, fs::copy_options::overwrite_existing, error);
      if (error) throw std::runtime_error(copy.string() + ": cannot be written");
    }
    own.specimen.file = "specimen.csv";
  }
  try {
    write_text(fs::path(folder) / "method.yaml",
               "# Everything resolved: runs again to the same curve.\n" + method_yaml(own));
  } catch (const std::runtime_error&) {
    throw InvalidInput("--out", folder, "a folder that can be written to");
  }
  return folder;
}

bool ties(const Program& program) {
  return std::any_of(program.begin(), program.end(), [](const ProgramStep& s) { return s.phase == Phase::kTie; });
}

/// One "key: value" line after the other.
class Lines {
 public:
  void number(const char* key, double value) { line(key, std::isnan(value) ? "null" : format_yaml_number(value)); }
  void number(const char* key, const std::optional<double>& value) { number(key, value.value_or(Sample::kNone)); }
  void count(const char* key, std::uint64_t value) { line(key, std::to_string(value)); }
  void flag(const char* key, bool value) { line(key, value ? "true" : "false"); }
  void word(const char* key, const std::string& value) { line(key, value); }
  void text(const char* key, const std::string& value) { line(key, value.empty() ? "null" : quoted(value)); }
  void pair(const char* key, const std::array<double, 2>& values) {
    if (std::isnan(values[0]) && std::isnan(values[1])) return line(key, "null");
    line(key, "[" + format_yaml_number(values[0]) + ", " + format_yaml_number(values[1]) + "]");
  }
  void list(const char* key, const std::vector<std::string>& texts) {
    std::string all;
    for (const std::string& entry : texts) all += (all.empty() ? "" : ", ") + quoted(entry);
    line(key, "[" + all + "]");
  }
  const std::string& all() const { return all_; }

 private:
  static std::string quoted(const std::string& value) {
    std::string result = "\"";
    for (const char c : value) {
      if (c == '"' || c == '\\') result += '\\';
      result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return result + '"';
  }
  void line(const char* key, const std::string& value) { all_ += std::string(key) + ": " + value + "\n"; }

  std::string all_;
};

}  // namespace

RunWriter::RunWriter(const std::string& folder, const Method& method)
    : folder_(make_folder(folder, method)),
      curve_((fs::path(folder) / "curve.csv").string()),
      full_curve_((fs::path(folder) / "curve_full.csv").string()) {
  if (ties(method.program)) known_.preload = method.specimen.preload.value_or(Sample::kNone);
  known_.seed = method.machine.load_cell.seed;
  known_.version = version();
}

void RunWriter::add(const Sample& sample, bool read_cell, const std::vector<Sample>& substeps) {
  for (const Sample& substep : substeps) {
    // A bench that has failed answers with the last good step again.
    if (substep.time <= last_step_time_) continue;
    full_curve_.write(substep);
    monitor_.add(substep);
    last_step_time_ = substep.time;
  }
  if (read_cell && sample.status != BenchStatus::kFailed) curve_.write(sample);
  monitor_.add(sample);
  if (sample.status != BenchStatus::kFailed) answers_.push_back(sample);
}

Results RunWriter::results(EndedBy ended_by) const { return analyse(answers_, ended_by); }

RunFacts RunWriter::facts() const {
  RunFacts facts = known_;
  monitor_.report(facts);
  facts.peak_memory = peak_memory();
  return facts;
}

void RunWriter::finish(const Results& results, const RunFacts& facts, const Points& final_shape) {
  if (final_shape.cols() > 0) write_centreline((fs::path(folder_) / "final_shape.csv").string(), final_shape);
  write_text(fs::path(folder_) / "result.yaml", result_yaml(results, facts));
}

std::string result_yaml(const Results& r, const RunFacts& f) {
  Lines lines;
  lines.word("motion_pattern", motion_pattern_name(r.motion_pattern));
  lines.number("motion_pattern_confidence", r.motion_pattern_confidence);
  lines.word("ended_by", ended_by_name(f.ended_by));
  lines.text("reason", f.reason);
  lines.list("warnings", f.warnings);
  lines.flag("not_equilibrated", f.not_equilibrated);
  lines.number("preload", f.preload);
  lines.number("tied_knot_distance", f.tied_knot_distance);
  lines.pair("excess_length", f.tied_excess_length);
  lines.number("plateau_force", r.plateau_force);
  lines.number("plateau_force_sd", r.plateau_force_sd);
  lines.number("lock_extension", r.lock_extension);
  lines.number("locked_stiffness", r.locked_stiffness);
  lines.number("peak_force", r.peak_force);
  lines.number("break_extension", r.break_extension);
  lines.number("untangled_at", r.untangled_at);
  lines.flag("knot_type_preserved", r.knot_type_preserved);
  lines.number("max_penetration", f.max_penetration);
  lines.number("fastest_node", f.fastest_node);
  lines.number("force_balance_error", f.force_balance_error);
  lines.number("energy_balance_error", f.energy_balance_error);
  lines.count("steps", f.steps);
  lines.count("rejected_steps", f.rejected_steps);
  lines.count("newton_iterations", f.newton_iterations);
  lines.number("simulated_time", f.simulated_time);
  lines.number("wall_time", f.wall_time);
  lines.number("real_time_factor", f.real_time_factor());
  lines.count("peak_memory", f.peak_memory);
  lines.count("seed", f.seed);
  lines.word("version", f.version);
  return lines.all();
}

}  // namespace knot_utm
