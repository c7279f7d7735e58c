#include "earlier_run.hpp"

#include <filesystem>
#include <set>
#include <system_error>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/run/checkpoint.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "physical_values.hpp"

namespace knot_utm {
namespace {

InvalidInput unsuited(const std::string& folder, const std::string& why) {
  return InvalidInput::sentence("--begin-with", folder, "cannot begin with " + shown(folder) + ": " + why);
}

/// As a message shows it.
std::string value_of(const YAML::Node& map, const std::string& key) {
  const YAML::Node value = map[key];
  return value.IsDefined() ? shown(YAML::Dump(value)) : "not set";
}

void check_values(const std::string& folder, const Method& earlier, const Method& method) {
  const YAML::Node there = physical_values(earlier), here = physical_values(method);
  for (const char* section : kPhysicalSections) {
    std::set<std::string> keys;
    for (const YAML::Node& map : {there[section], here[section]})
      for (const auto& item : map) keys.insert(item.first.Scalar());
    for (const std::string& key : keys) {
      const std::string its = value_of(there[section], key), own = value_of(here[section], key);
      if (its != own)
        throw unsuited(folder, std::string(section) + "." + key + " is " + its + " there, and " + own + " here");
    }
  }
  if (knot_of(method.specimen).has("file") && read_whole(earlier.specimen.file) != read_whole(method.specimen.file))
    throw unsuited(folder, "the shape of its specimen is another one");
}

}  // namespace

Beginning begin_with_earlier(const std::string& folder, const std::string& out, const Method& method,
                             TestingMachine& bench, ProgramRunner& program) {
  std::error_code error;
  if (std::filesystem::equivalent(folder, out, error))
    throw unsuited(folder, "the run would write over it: choose another folder by --out");
  const std::string file = (std::filesystem::path(folder) / "method.yaml").string();
  if (!std::filesystem::exists(file)) throw unsuited(folder, "it holds no run");
  const Method earlier = load_method(file);
  const Checkpoint checkpoint(folder, method_file_text(earlier));
  if (!checkpoint.is_there())
    throw unsuited(folder, "it has no checkpoint; make one by tensile_test --stop-before, such as --stop-before pull");
  check_values(folder, earlier, method);
  ProgramRunner its_own = make_program(earlier, bench.longest_step());
  checkpoint.load(bench, its_own);
  Beginning beginning([folder](const Beginning::Visitor& visit) {
    SamplesReader samples(folder);
    Record record;
    while (samples.next(record)) visit(record);
  });
  if (const std::string why = beginning.follow(program); !why.empty()) throw unsuited(folder, why);
  if (program.last().sequence != its_own.last().sequence) throw unsuited(folder, "its samples.csv is damaged");
  return beginning;
}

}  // namespace knot_utm
