#include "knot_utm/study/readings.hpp"

#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/settings/accuracy.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

constexpr const char* kOption = "--readings";
constexpr const char* kPlateauWord = "plateau";

}  // namespace

std::string words_of(Readings readings) {
  return readings == Readings::kPlateau ? std::string(kOption) + " " + kPlateauWord : "";
}

Readings readings_named(const std::string& word) {
  if (word != kPlateauWord) throw InvalidInput(kOption, word, kPlateauWord);
  return Readings::kPlateau;
}

void require_readings(const Method& method, Readings readings) {
  if (readings == Readings::kAll) return;
  if (method.specimen.to_be_tied && rollers_hold(method.specimen, method.machine) && has_step<PullStep>(method.program))
    return;
  throw InvalidInput::sentence(
      kOption, kPlateauWord,
      words_of(readings) +
          ": this test has no plateau, which only a loop has that is tied (step tie), held by rollers and pulled");
}

EarlyEnd::EarlyEnd(const Method& method, Readings readings) {
  if (readings == Readings::kPlateau)
    watch_.emplace(method.material.radius,
                   relative_errors(method.specimen, method.material, method.machine, method.physics).plateau_force);
}

void EarlyEnd::add(const Record& record) {
  if (!watch_ || !reason_.empty()) return;
  for (const Sample& step : record.steps) watch_->add(step);
  const Sample* reading = cell_reading(record);
  if (reading && watch_->settled_by(*reading))
    reason_ = "the plateau was settled at an extension of " + short_number(reading->extension) + " m";
}

void EarlyEnd::end(ProgramRunner& program) const {
  if (!reason_.empty()) program.plateau_settled(reason_);
}

}  // namespace knot_utm
