#include "knot_utm/study/tied_specimen.hpp"

#include <yaml-cpp/yaml.h>

#include <exception>
#include <filesystem>
#include <functional>
#include <system_error>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

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

std::string bytes_of(Command command) {
  Archive archive("command");
  command.state(archive);
  return archive.bytes();
}

/// The program sees all answers without any physics. Whether it asks for them; one that does not is then unusable.
bool asks_for(const std::vector<Record>& records, ProgramRunner& program) {
  for (const Record& record : records) {
    if (bytes_of(record.command) != bytes_of(program.last())) return false;
    program.next(record.answer);
    if (program.ended()) return false;
  }
  return true;
}

/// The program that computes: its version and, for those who change it, when it was linked.
std::string code() {
  std::error_code error;
  const auto linked = fs::last_write_time("/proc/self/exe", error).time_since_epoch().count();
  return "version " + version() + " of " + std::to_string(linked) + '\n';
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
  const YAML::Node values = physical_values(method);
  std::string text = code() + (shapes ? "with shapes\n" : "without shapes\n");
  for (const char* section : kPhysicalSections)
    if (values[section]) text += std::string(section) + ":\n" + YAML::Dump(values[section]) + '\n';
  for (int i = 0; i < step; ++i) text += "step: " + YAML::Dump(values["program"][i]) + '\n';
  if (knot_of(method.specimen).has("file")) text += "shape:\n" + read_whole(method.specimen.file);
  return text;
}

std::optional<TiedSpecimen> TiedSpecimen::of(const Method& method, bool shapes, const std::string& folder) {
  const std::optional<int> step = step_after_tying(method.program);
  if (!step) return std::nullopt;
  std::string made_from = tied_from(method, *step, shapes);
  fs::path run = fs::absolute(folder).lexically_normal();
  if (!run.has_filename()) run = run.parent_path();
  const std::string name = std::to_string(std::hash<std::string>()(made_from) % kFiles);
  return TiedSpecimen((run.parent_path() / ".tied" / name).string(), *step, std::move(made_from));
}

std::optional<std::vector<Record>> TiedSpecimen::restore(const Method& method, TestingMachine& bench,
                                                         ProgramRunner& program) const {
  std::error_code error;
  // Opening anything else than a file could wait for ever.
  if (!fs::is_regular_file(file_, error)) return std::nullopt;
  bool begun = false;
  try {
    Archive archive(kKind, read_whole(file_), file_);
    std::string made_from;
    archive(made_from);
    archive.require(made_from == made_from_, "origin", "another specimen");
    std::vector<Record> records;
    archive.list(records);
    ProgramRunner followed = program;
    if (!asks_for(records, followed) || followed.last().step != step_) return std::nullopt;
    begun = true;
    archive(bench);
    archive.end();
    program = followed;
    return records;
  } catch (const std::exception&) {
    if (begun) bench = TestingMachine(method.specimen, method.material, method.machine, method.physics);
    return std::nullopt;
  }
}

void TiedSpecimen::add(const Record& record) {
  if (!kept_) records_.push_back(record);
}

void TiedSpecimen::keep(TestingMachine& bench, const ProgramRunner& program, const std::string& folder) {
  if (kept_ || program.last().step < step_) return;
  kept_ = true;
  const std::string part = (fs::path(folder) / "tied").string();
  std::error_code error;
  try {
    Archive archive(kKind);
    archive(made_from_);
    archive.list(records_);
    archive(bench);
    write_whole(part, archive.bytes());
    fs::create_directory(fs::path(file_).parent_path(), error);
    fs::rename(part, file_, error);
    if (error) fs::remove(part, error);
  } catch (const std::exception&) {  // no room for it: the test goes on without
  }
  records_ = {};
}

}  // namespace knot_utm
