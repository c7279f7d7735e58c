#include "knot_utm/program/program.hpp"

#include "knot_utm/program/course.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

const Program& all_steps() {
  static const Program all{
      TieStep(),  ReleaseStep(), MountStep(),  PreloadStep(), BalanceStep(), PullStep(),
      HoldStep(), CycleStep(),   ReturnStep(), FollowStep(),  TwistStep(),
  };
  return all;
}

std::vector<std::string> step_names() {
  std::vector<std::string> names;
  for (const ProgramStep& step : all_steps()) names.emplace_back(step->name());
  return names;
}

std::optional<ProgramStep> step_named(const std::string& name) {
  for (const ProgramStep& step : all_steps())
    if (name == step->name()) return step;
  return std::nullopt;
}

std::optional<int> step_called(const Program& program, const std::string& name) {
  std::optional<int> found;
  for (std::size_t i = 0; i < program.size(); ++i) {
    if (name == std::to_string(i)) return static_cast<int>(i);
    if (name != program[i]->name()) continue;
    if (found) return std::nullopt;
    found = static_cast<int>(i);
  }
  return found;
}

EndedBy Step::ended(const Sample&, CrossheadCourse& course) {
  return course.over(usual_duration(course)) ? EndedBy::kProgram : EndedBy::kNotYet;
}

std::string StepPlace::key() const { return "program." + std::to_string(index) + "." + program[index]->name(); }

void StepPlace::misplaced(const std::string& why) const {
  const std::string entry = "program." + std::to_string(index), name = program[index]->name();
  throw InvalidInput::sentence(entry, entry + ": " + name + " " + why);
}

void StepPlace::needs(const std::string& knots) const {
  if (!knots.empty()) misplaced("needs specimen.knot: " + knots + "; begin the program with another step");
}

namespace {

struct Row {
  const char* name;
  unsigned traits;
};

/// In the order of the numbers.
const std::vector<Row>& rows() {
  static const std::vector<Row> all = [] {
    std::vector<Row> out{{"idle", Step::kPrepares}};
    for (const ProgramStep& step : all_steps()) out.push_back({step->name(), step->traits()});
    out.insert(out.begin() + static_cast<std::ptrdiff_t>(Phase::kDone), {"done", Step::kPrepares});
    return out;
  }();
  return all;
}

const Row& row(Phase phase) {
  const std::size_t place = static_cast<std::size_t>(phase);
  return rows()[place < rows().size() ? place : 0];
}

bool has(Phase phase, Step::Trait trait) { return (row(phase).traits & trait) != 0; }

}  // namespace

const char* phase_name(Phase phase) { return row(phase).name; }

std::optional<Phase> phase_named(const std::string& name) {
  for (std::size_t i = 0; i < rows().size(); ++i)
    if (name == rows()[i].name) return static_cast<Phase>(i);
  return std::nullopt;
}

Phase last_phase() { return static_cast<Phase>(rows().size() - 1); }

std::vector<Phase> all_phases() {
  std::vector<Phase> out;
  for (std::size_t i = 0; i < rows().size(); ++i) out.push_back(static_cast<Phase>(i));
  return out;
}

bool prepares(Phase phase) { return has(phase, Step::kPrepares); }
bool forms(Phase phase) { return has(phase, Step::kForms); }
bool ends_by_itself(Phase phase) { return has(phase, Step::kEndsByItself); }
bool rests(Phase phase) { return has(phase, Step::kRests); }
bool moves(Phase phase) { return has(phase, Step::kMoves); }
bool loads(Phase phase) { return has(phase, Step::kLoads); }
bool pulls(Phase phase) { return has(phase, Step::kPulls); }
bool can_break(Phase phase) { return has(phase, Step::kCanBreak); }

}  // namespace knot_utm
