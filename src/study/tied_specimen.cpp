#include "knot_utm/study/tied_specimen.hpp"

#include <yaml-cpp/yaml.h>

#include <exception>
#include <memory>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/record/phase.hpp"
#include "knot_utm/record/preparing_steps.hpp"
#include "knot_utm/run/build_identity.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"

namespace knot_utm {
namespace {

constexpr const char* kKind = "tied specimen";

/// The sections of a method on which depends what the simulated machine answers.
constexpr const char* kPhysicalSections[] = {"specimen", "material", "other_material", "machine", "physics"};

/// The values of a method but its names and notes, which change nothing. A specimen's file is named as the copy in a
/// run's folder is.
YAML::Node physical_values(const Method& method) {
  YAML::Node values = YAML::Load(method_file_text(method));
  for (const char* words : {"name", "notes"}) {
    values["material"].remove(words);
    if (method.material.other) values["other_material"].remove(words);
    values["machine"]["load_cell"].remove(words);
  }
  // What a knot's file says, whatever it is called.
  if (method.specimen.drawing) values["specimen"]["knot"] = method.specimen.drawing->text;
  return values;
}

}  // namespace

std::optional<int> step_after_tying(const Program& program) {
  bool tied = false;
  for (std::size_t i = 0; i < program.size(); ++i) {
    const Phase phase = program[i]->phase();
    if (!ends_by_itself(phase) && !rests(phase)) return tied ? std::optional<int>(static_cast<int>(i)) : std::nullopt;
    tied |= phase == Phase::kTie;
  }
  return std::nullopt;
}

std::string tied_from(const Method& method, int step, bool shapes) {
  const std::string& code = build_identity();
  if (code.empty()) return {};
  const YAML::Node values = physical_values(method);
  std::string text = code + (shapes ? "with shapes\n" : "without shapes\n");
  for (const char* section : kPhysicalSections)
    if (values[section]) text += std::string(section) + ":\n" + YAML::Dump(values[section]) + '\n';
  for (int i = 0; i < step; ++i) text += "step: " + YAML::Dump(values["program"][i]) + '\n';
  if (knot_of(method.specimen).has("file")) text += "shape:\n" + read_whole(method.specimen.file);
  return text;
}

std::optional<TiedSpecimen> TiedSpecimen::of(const Method& method, bool shapes, const CacheFolder& cache) {
  const std::optional<int> step = step_after_tying(method.program);
  if (!step) return std::nullopt;
  std::string made_from = tied_from(method, *step, shapes);
  if (made_from.empty()) return std::nullopt;
  return TiedSpecimen(cache, *step, std::move(made_from));
}

std::optional<Beginning> TiedSpecimen::take_up(const Method& method, TestingMachine& bench,
                                               ProgramRunner& program) const {
  bool begun = false;
  try {
    std::optional<std::string> bytes = cache_.read(made_from_);
    if (!bytes) return std::nullopt;
    Archive archive(kKind, std::move(*bytes), cache_.file_of(made_from_));
    std::string made_from;
    archive(made_from);
    archive.require(made_from == made_from_, "origin", "another specimen");
    const auto records = std::make_shared<std::vector<Record>>();
    archive.list(*records);
    Beginning beginning([records](const Beginning::Visitor& visit) {
      for (const Record& record : *records) visit(record);
    });
    ProgramRunner followed = program;
    if (!beginning.follow(followed) || followed.last().step != step_) return std::nullopt;
    begun = true;
    archive(bench);
    archive.end();
    program = followed;
    return beginning;
  } catch (const std::exception&) {
    if (begun) bench = TestingMachine(method.specimen, method.material, method.machine, method.physics);
    return std::nullopt;
  }
}

void TiedSpecimen::add(const Record& record) {
  if (!kept_) records_.push_back(record);
}

void TiedSpecimen::keep(TestingMachine& bench, const ProgramRunner& program) {
  if (kept_ || program.last().step < step_) return;
  kept_ = true;
  try {
    Archive archive(kKind);
    archive(made_from_);
    archive.list(records_);
    archive(bench);
    cache_.write(made_from_, archive.bytes());
  } catch (const std::exception&) {  // too little memory: the test goes on without
  }
  records_ = {};
}

}  // namespace knot_utm
