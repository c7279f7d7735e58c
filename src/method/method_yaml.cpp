// The method written as YAML.
#include "knot_utm/grips/grips.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "method_overrides.hpp"
#include "method_reader.hpp"
#include "overruled_keys.hpp"
#include "specimens_section.hpp"

namespace knot_utm {

using fields::Fields;
using fields::Writer;

namespace {

/// Keys that another choice leaves without effect have plain values, which suit no rod, and would say what the test is
/// not.
void leave_out_idle_keys(const Method& m, YAML::Node& root) {
  const Knot& knot = knot_of(m.specimen);
  std::vector<std::string> idle;
  for (const auto& item : root["specimen"])
    if (!knot.has(item.first.Scalar())) idle.push_back(item.first.Scalar());
  for (const std::string& key : idle) root["specimen"].remove(key);
  if (!knot.about().loop) root["machine"].remove("roller_diameter");
  if (!rollers_hold(m.specimen, m.machine)) root["machine"].remove("far_side");
}

}  // namespace

std::string method_yaml(const Method& method) {
  Method m = method;
  Writer top;
  fields::before_program(top, m);
  YAML::Node root = top.map();
  for (ProgramStep& step : m.program) {
    Writer entry;
    entry.section(step->name(), [&](Fields& f) { step->keys(f, 0.0); });
    YAML::Node entry_map = entry.map();
    entry_map.SetStyle(YAML::EmitterStyle::Flow);
    root["program"].push_back(entry_map);
  }
  fields::behind_program(top, m);
  top.section("report", [&](Fields& f) { fields::report(f, m.report); });
  for (Requirement& required : m.specification) {
    Writer limits;
    fields::requirement(limits, required);
    YAML::Node limits_map = limits.map();
    limits_map.SetStyle(YAML::EmitterStyle::Flow);
    root["specification"][required.key] = limits_map;
  }
  leave_out_idle_keys(method, root);
  // A single specimen is the one that the method describes.
  if (m.specimens.count > 1) root["specimens"] = specimens_map(m.specimens);
  for (const auto& [key, value] : m.automatic) root["automatic"][key] = value;
  YAML::Emitter out;
  out << root;
  return std::string(out.c_str()) + "\n";
}

std::optional<double> number_at(const Method& method, const std::string& key) {
  Method one = method;
  one.specimens.count = 1;
  keep_own_keys(one);
  const YAML::Node value = value_at(YAML::Load(method_yaml(one)), key);
  if (!value.IsDefined() || !value.IsScalar()) return std::nullopt;
  return parse_number(value.Scalar());
}

}  // namespace knot_utm
