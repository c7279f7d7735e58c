#include "knot_utm/method/method.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "config_library.hpp"
#include "knot_utm/grips/grips.hpp"
#include "knot_utm/method/knot_file.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/tying/before_tying.hpp"
#include "knot_utm/words/number.hpp"
#include "method_defaults.hpp"
#include "method_fields.hpp"
#include "method_reader.hpp"
#include "overruled_keys.hpp"
#include "specimens_section.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using fields::as_given;
using fields::Fields;
using fields::one_line;
using fields::Reader;

/// `key`: that of the method.
Material read_material(const std::string& key, const YAML::Node& node, const std::string& file,
                       const ConfigLibrary& library) {
  Material material;
  if (!node.IsDefined() || node.IsNull()) throw InvalidInput::missing(key, library.allowed("materials")).in_file(file);
  if (!node.IsScalar() && !node.IsMap()) throw InvalidInput(file, key, as_given(node), library.allowed("materials"));
  if (node.IsScalar()) {
    const fs::path path = library.find("materials", node.Scalar(), key);
    Reader reader(read_yaml(path), path.string(), "", "a material");
    fields::material(reader, material);
    reader.finish();
    if (material.name.empty()) material.name = path.stem().string();
  } else {
    Reader reader(node, file, key);
    fields::material(reader, material);
    reader.finish();
    if (material.name.empty()) material.name = "own";
  }
  return material;
}

LoadCellOptions read_load_cell(const YAML::Node& node, const std::string& file, const Material& material,
                               const LoadCellOptions& by_default, const ConfigLibrary& library,
                               std::vector<std::string>& automatic) {
  LoadCellOptions cell = by_default;
  const std::optional<std::string> name = load_cell_name(node, material.load_cell);
  if (node.IsSequence()) throw InvalidInput(file, "machine.load_cell", as_given(node), library.allowed("load_cells"));
  if (node.IsDefined() && !node.IsNull() && !node.IsScalar()) {
    Reader reader(node, file, "machine.load_cell");
    reader.note_automatic(automatic);
    fields::load_cell(reader, cell);
    reader.finish();
    if (cell.name.empty()) cell.name = "own";
  } else if (!name) {
    cell.name = "auto";
    automatic.emplace_back("machine.load_cell.capacity");
  } else {
    const fs::path path = library.find("load_cells", *name, "machine.load_cell");
    Reader reader(read_yaml(path), path.string(), "", "a load cell");
    fields::load_cell(reader, cell);
    reader.finish();
    if (cell.name.empty()) cell.name = path.stem().string();
  }
  return cell;
}

/// Notes the keys that are `automatic`.
Program read_program(const YAML::Node& node, const std::string& file, const Material& material,
                     const fields::Defaults& defaults, std::vector<std::string>& automatic) {
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
    std::optional<ProgramStep> step = step_named(name);
    if (!step) throw InvalidInput::unknown_name(path, name, listed(steps), steps).in_file(file);
    (*step)->speed *= defaults.scale;
    Reader reader(node[i].begin()->second, file, path + "." + name);
    reader.understand(material);
    reader.note_automatic(automatic);
    (*step)->keys(reader, defaults.way);
    reader.finish();
    program.push_back(*step);
  }
  return program;
}

Specification read_specification(const YAML::Node& node, const std::string& file) {
  const std::string key = "specification";
  Specification specification;
  if (!node.IsDefined() || node.IsNull()) return specification;
  if (!node.IsMap())
    throw InvalidInput(file, key, as_given(node), "a map such as {peak_force: {min: 100}}, of numbers of result.yaml");
  for (const auto& item : node) {
    Requirement required;
    required.key = one_line(item.first);
    const std::string path = key + "." + required.key;
    const auto is_it = [&](const Requirement& other) { return other.key == required.key; };
    if (std::any_of(specification.begin(), specification.end(), is_it))
      throw InvalidInput::sentence(path, shown(path) + " stands twice; give it once").in_file(file);
    Reader reader(item.second, file, path);
    fields::requirement(reader, required);
    reader.finish();
    if (!required.min && !required.max) throw InvalidInput::missing(path, "min, max or both").in_file(file);
    if (required.min && required.max && *required.min > *required.max)
      throw InvalidInput(file, path, one_line(item.second), "a map whose min is no larger than its max");
    specification.push_back(required);
  }
  return specification;
}

/// As the method.yaml of a run has it.
std::map<std::string, std::string> read_automatic(const YAML::Node& node, const std::string& file) {
  std::map<std::string, std::string> found;
  if (!node.IsDefined() || node.IsNull()) return found;
  if (!node.IsMap())
    throw InvalidInput(file, "automatic", as_given(node),
                       "a map of keys and the values that auto gave them, as method.yaml of a run has it");
  for (const auto& item : node) found[one_line(item.first)] = one_line(item.second);
  return found;
}

/// What `auto` gave: what this reading noted and what an earlier one did, as far as the values are still the same.
void keep_automatic(const std::vector<std::string>& noted, Method& method) {
  const std::map<std::string, std::string> earlier = std::move(method.automatic);
  method.automatic.clear();
  const YAML::Node values = YAML::Load(method_yaml(method));
  const auto written = [&](const std::string& key) {
    const YAML::Node value = value_at(values, key);
    return value.IsDefined() && value.IsScalar() ? value.Scalar() : "";
  };
  for (const std::string& key : noted)
    if (!written(key).empty()) method.automatic[key] = written(key);
  for (const auto& [key, value] : earlier)
    if (written(key) == value) method.automatic[key] = value;
}

/// The speed with which friction may creep, where its law has one.
void set_creep(FrictionLaw law, double speed, FrictionOptions& friction) {
  for (const LawKey& key : FrictionRegistry::keys())
    if (key.otherwise == LawDefault::kCreep && FrictionRegistry::entry(law).has(key.name))
      friction.set(key.name, speed);
}

/// The drawing of a knot that a file describes; of another knot none.
std::shared_ptr<const KnotDrawing> read_drawing(const YAML::Node& knot, const std::string& method,
                                                const ConfigLibrary& library) {
  if (!knot.IsDefined()) return nullptr;
  if (!knot.IsScalar() || knot.Scalar().empty())
    throw InvalidInput(method, "specimen.knot", as_given(knot), kAllowedKnot);
  const std::string& given = knot.Scalar();
  const std::vector<std::string> coded = knot_names(nullptr);
  if (std::find(coded.begin(), coded.end(), given) != coded.end()) return nullptr;
  const fs::path file = library.find("knots", given, "specimen.knot", coded);
  return read_knot_file(
      file, is_shipped("knots", file) ? file.stem().string() : fs::absolute(file).lexically_normal().string());
}

/// The method over defaults that suit its knot and material, and, once it has been read with these, what is `known` of
/// the rest. Notes the keys whose values are `automatic`.
Method read_method(const YAML::Node& root, const std::string& file, const ConfigLibrary& library, const Method* known,
                   std::vector<std::string>& automatic) {
  Method method;
  Reader top(root, file, "");
  top.note_automatic(automatic);
  method.material = read_material("material", top.take("material"), file, library);
  if (const YAML::Node other = top.take("other_material"); other.IsDefined())
    method.material.other = std::make_shared<const Material>(read_material("other_material", other, file, library));
  Reader specimen = top.in("specimen");
  YAML::Node knot = specimen.take("knot");
  method.specimen.drawing = read_drawing(knot, file, library);
  if (method.specimen.drawing) knot = method.specimen.drawing->name;  // a path may be given in many ways
  fields::knot(specimen, method.specimen);
  const fields::Defaults defaults = fields::defaults(method.specimen, method.material, known);
  method.specimen = defaults.specimen;
  fields::specimen(specimen, method.specimen);
  specimen.finish();
  method.machine = defaults.machine;
  Reader machine = top.in("machine");
  fields::machine(machine, method.machine);
  method.machine.load_cell =
      read_load_cell(machine.take("load_cell"), file, method.material, defaults.machine.load_cell, library, automatic);
  machine.finish();
  method.program = read_program(top.take("program"), file, method.material, defaults, automatic);
  if (known) set_creep(known->physics.friction.law, defaults.slip_tolerance, method.physics.friction);
  fields::behind_program(top, method);
  top.section("report", [&](Fields& f) { fields::report(f, method.report); });
  method.specification = read_specification(top.take("specification"), file);
  bool usual_scatter = true;
  method.specimens = read_specimens(top.take("specimens"), file, usual_scatter);
  if (usual_scatter) method.specimens.scatter = default_scatter(method);
  method.automatic = read_automatic(top.take("automatic"), file);
  top.finish();
  return method;
}

}  // namespace

Method load_method(const std::string& file, const std::vector<std::string>& overrides, const std::string& option) {
  return parse_method(read_text(file), file, overrides, option);
}

Method parse_method(const std::string& text, const std::string& file, const std::vector<std::string>& overrides,
                    const std::string& option) {
  const fs::path path(file);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  YAML::Node root = parse_yaml(text, file);
  try {
    const ConfigLibrary library(folder);
    if (!root.IsMap())
      throw InvalidInput("the file", as_given(root), "a map with the keys specimen, material, machine and program");
    apply_overrides(root, overrides, option, library);

    std::vector<std::string> noted_first, noted;
    const Method first = read_method(root, file, library, nullptr, noted_first);
    Method method = read_method(root, file, library, &first, noted);
    method.name = path.stem().string();
    method.specimen.to_be_tied = has_step<TieStep>(method.program);

    if (!method.material.friction_couple) {
      method.material.friction_couple = default_friction_couple(method.material);
      noted.emplace_back("material.friction_couple");
    }
    if (method.physics.twist == TwistMode::kAuto && has_step<TwistStep>(method.program)) {
      method.physics.twist = TwistMode::kOn;  // of a straight rod, which has none by itself
      noted.emplace_back("physics.twist");
    }
    if (method.material.other && !method.material.other->friction_couple)
      change_other(method.material, [&](Material& o) { o.friction_couple = method.material.friction_couple; });
    drop_overruled_keys(parse_yaml(text, file), overrides, method);
    const Material& material = method.material;
    if (!method.specimen.preload && knot_of(method.specimen).has("preload") && preload_acts(method.specimen)) {
      method.specimen.preload = default_preload(material);
      noted.emplace_back("specimen.preload");
    }
    if (!method.specimen.tail_load && knot_of(method.specimen).has("tail_load")) {
      method.specimen.tail_load = tail_load(method.specimen, material);
      noted.emplace_back("specimen.tail_load");
    }
    check_method(method);
    keep_own_keys(method);
    keep_automatic(noted, method);
    return method;
  } catch (const InvalidInput& invalid) {
    if (invalid.key == option) throw;  // an override stands in no file
    throw invalid.in_file(file);
  } catch (const YAML::Exception& yaml) {
    throw InvalidInput::sentence("the file", "the file is no method: " + yaml_fault(yaml)).in_file(file);
  }
}

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
