// The method written as YAML.
#include "knot_utm/io/method.hpp"
#include "knot_utm/machine/grips.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "method_overrides.hpp"
#include "method_reader.hpp"
#include "specimens_section.hpp"

namespace knot_utm {

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
  YAML::Node root;
  Writer specimen;
  fields::specimen(specimen, m.specimen);
  root["specimen"] = specimen.map();
  Writer material;
  fields::material(material, m.material);
  root["material"] = material.map();
  Writer machine;
  fields::machine(machine, m.machine);
  YAML::Node machine_map = machine.map();
  Writer cell;
  fields::load_cell(cell, m.machine.load_cell);
  machine_map["load_cell"] = cell.map();
  root["machine"] = machine_map;
  for (ProgramStep& step : m.program) {
    Writer writer;
    fields::step(writer, step);
    YAML::Node entry_map;
    entry_map[phase_name(step.phase)] = writer.map();
    entry_map.SetStyle(YAML::EmitterStyle::Flow);
    root["program"].push_back(entry_map);
  }
  Writer ends;
  fields::ends(ends, m.ends);
  root["ends"] = ends.map();
  Writer physics;
  fields::physics(physics, m.physics);
  root["physics"] = physics.map();
  Writer analysis;
  fields::analysis(analysis, m.analysis);
  root["analysis"] = analysis.map();
  Writer report;
  fields::report(report, m.report);
  root["report"] = report.map();
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
  const YAML::Node value = value_at(YAML::Load(method_yaml(one)), key);
  if (!value.IsDefined() || !value.IsScalar()) return std::nullopt;
  return parse_number(value.Scalar());
}

}  // namespace knot_utm
