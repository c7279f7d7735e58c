#include "method_program.hpp"

#include <algorithm>
#include <optional>
#include <system_error>
#include <vector>

#include "knot_utm/io/curve_file.hpp"
#include "knot_utm/io/raw_zero.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/known_names.hpp"
#include "method_reader.hpp"

namespace knot_utm {
namespace {

using fields::as_given;
using fields::one_line;
using fields::Reader;

ProgramStep default_step(Phase phase, double scale) {
  ProgramStep step;
  step.phase = phase;
  step.speed *= scale;
  if (phase == Phase::kTie) step.speed = 0.01 * scale;
  if (phase == Phase::kRelease) step.duration = 3.0;
  return step;
}

}  // namespace

Program read_program(const YAML::Node& node, const std::string& file, const fields::Defaults& defaults,
                     std::vector<std::string>& automatic) {
  const std::vector<std::string> steps = step_names();
  const std::string form = "a list of steps, such as [{pull: {until: {break: true}}}]";
  if (!node.IsDefined() || node.IsNull()) throw InvalidInput::missing("program", form).in_file(file);
  if (!node.IsSequence() || node.size() == 0) throw InvalidInput(file, "program", as_given(node), form);
  Program program;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string path = "program." + std::to_string(i);
    if (!node[i].IsMap() || node[i].size() != 1)
      throw InvalidInput(file, path, as_given(node[i]), "one step, {NAME: {...}}, where NAME is " + listed(steps));
    const std::string name = one_line(node[i].begin()->first);
    if (std::find(steps.begin(), steps.end(), name) == steps.end())
      throw InvalidInput::unknown_name(path, name, listed(steps), steps).in_file(file);
    ProgramStep step = default_step(*phase_named(name), defaults.scale);
    Reader reader(node[i].begin()->second, file, path + "." + name);
    reader.understand(defaults.loads);
    reader.note_automatic(automatic);
    fields::step(reader, step, defaults.way);
    reader.finish();
    program.push_back(step);
  }
  return program;
}

void read_record(const std::filesystem::path& folder, const std::string& follow, ProgramStep& step) {
  const std::string key = follow + ".record";
  if (step.record.empty()) throw InvalidInput::missing(key, "a curve.csv, or raw data of a testing machine");
  const RawSpelling spelling{follow + ".", ": ", false};
  const RawOptions options = raw_options(step.words, spelling);
  const std::filesystem::path given = std::filesystem::absolute(folder / step.record).lexically_normal();
  step.record = curve_file_of(given.string(), options);
  std::error_code error;
  if (!std::filesystem::is_regular_file(step.record, error)) throw InvalidInput::cannot_read(step.record, key);
  step.recorded.clear();
  step.read.clear();
  const std::vector<CurveRow> course =
      read_course(step.record, options, [&](const std::string& line) { step.read.push_back(line); });
  const std::string unused = without_effect(step.words, spelling, step.record != given.string());
  if (!unused.empty() && has_its_zero(course))
    step.read.push_back(step.record + ": the curve is one of knot_utm, for which " + unused);
  for (const CurveRow& row : course) {
    const RecordedPlace place{row.time - course.front().time, row.extension - course.front().extension};
    if (step.recorded.empty() || place.time > step.recorded.back().time) step.recorded.push_back(place);
  }
  if (step.recorded.size() < 2)
    throw InvalidInput::sentence(
        key, step.record,
        key + ": " + shown(step.record) + " has fewer than 2 readings of the pull at different times");
}

}  // namespace knot_utm
