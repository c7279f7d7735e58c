#include "method_program.hpp"

#include <algorithm>
#include <optional>
#include <vector>

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
    if (step.phase == Phase::kFollow && step.record.empty())
      throw InvalidInput::missing(path + ".follow.record", "a curve.csv, or raw data of a testing machine");
    program.push_back(step);
  }
  return program;
}

}  // namespace knot_utm
