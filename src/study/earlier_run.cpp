#include "earlier_run.hpp"

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <set>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/run/checkpoint.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {

namespace {

InvalidInput unsuited(const std::string& folder, const std::string& why) {
  return InvalidInput::sentence("--begin-with", folder, "cannot begin with " + shown(folder) + ": " + why);
}

/// All but names and notes, which change nothing.
YAML::Node values_of(const Method& method) {
  YAML::Node values = YAML::Load(method_file_text(method));
  for (const char* words : {"name", "notes"}) {
    values["material"].remove(words);
    values["machine"]["load_cell"].remove(words);
  }
  return values;
}

/// As a message shows it.
std::string value_of(const YAML::Node& map, const std::string& key) {
  const YAML::Node value = map[key];
  return value.IsDefined() ? shown(YAML::Dump(value)) : "not set";
}

std::string bytes_of(Command command) {
  Archive archive("command");
  command.state(archive);
  return archive.bytes();
}

}  // namespace

EarlierRun::EarlierRun(const std::string& folder, const std::string& out, const Method& method, TestingMachine& bench,
                       ProgramRunner& program)
    : folder_(folder) {
  std::error_code error;
  if (std::filesystem::equivalent(folder, out, error))
    throw unsuited(folder, "the run would write over it: choose another folder by --out");
  const std::string file = (std::filesystem::path(folder) / "method.yaml").string();
  if (!std::filesystem::exists(file)) throw unsuited(folder, "it holds no run");
  method_ = load_method(file);
  const Checkpoint checkpoint(folder, method_file_text(method_));
  if (!checkpoint.is_there())
    throw unsuited(folder, "it has no checkpoint; make one by tensile_test --stop-before, such as --stop-before pull");
  check_method(method);
  ProgramRunner its_own = make_program(method_, bench.longest_step());
  checkpoint.load(bench, its_own);
  follow(program, its_own.last().sequence);
}

void EarlierRun::check_method(const Method& method) const {
  const YAML::Node there = values_of(method_), here = values_of(method);
  for (const char* section : {"specimen", "material", "machine", "physics"}) {
    std::set<std::string> keys;
    for (const YAML::Node& map : {there[section], here[section]})
      for (const auto& item : map) keys.insert(item.first.Scalar());
    for (const std::string& key : keys) {
      const std::string its = value_of(there[section], key), own = value_of(here[section], key);
      if (its != own)
        throw unsuited(folder_, std::string(section) + "." + key + " is " + its + " there, and " + own + " here");
    }
  }
  if (knot_of(method.specimen).has("file") && read_whole(method_.specimen.file) != read_whole(method.specimen.file))
    throw unsuited(folder_, "the shape of its specimen is another one");
}

/// The program sees all answers once more, without any physics, and must have asked the same.
void EarlierRun::follow(ProgramRunner& program, std::uint64_t records) const {
  SamplesReader samples(folder_);
  Record record;
  while (samples.next(record)) {
    if (bytes_of(record.command) != bytes_of(program.last()))
      throw unsuited(
          folder_, "the programs differ from " + format_number(record.command.time) + " s on, before that run stopped");
    program.next(record.answer);
    if (program.ended()) throw unsuited(folder_, "this test ends before that run stopped");
  }
  if (samples.records() != records) throw unsuited(folder_, "its samples.csv is damaged");
}

double EarlierRun::replay(SamplesWriter& samples) const {
  SamplesReader earlier(folder_);
  Record record;
  while (earlier.next(record)) samples.append(record);
  return record.wall_time;
}

}  // namespace knot_utm
