#include "knot_utm/method/method.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "config_library.hpp"
#include "knot_utm/grips/grips.hpp"
#include "knot_utm/method/knot_file.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/tying/before_tying.hpp"
#include "knot_utm/words/number.hpp"
#include "method_parts.hpp"
#include "method_reader.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using fields::as_given;
using fields::Fields;
using fields::kind_of;
using fields::one_line;
using fields::Reader;

constexpr double kLeastTravel = 1.0, kLargestTravel = 100.0;  // [m]
constexpr double kTravelOverWay = 2.0;                        // slack and balance take some of the crosshead's way, too

constexpr double kCreep = 1.0 / 3.3;  // friction that creeps is Coulomb's well above this fraction of the slowest pull

constexpr double kMarginOfCell = 2.5;                            // over the strength of one strand: a loop has two
constexpr double kLeastCapacity = 1e-3, kLargestCapacity = 1e8;  // [N]

/// The largest of the program's numbers that have this unit.
double largest(const Program& program, const std::string& unit) {
  double out = 0.0;
  for (const ProgramStep& step : program)
    for (const MethodKey& number : step_keys(step, ""))
      if (number.unit == unit) out = std::max(out, std::abs(number.value.value_or(0.0)));
  return out;
}

/// The slowest speed of the steps that pull; where there is none, the paper's [m/s].
double slowest_pull(const Program& program, double scale) {
  double out = PullStep().speed * scale;
  for (const ProgramStep& step : program)
    if (pulls(step->phase())) out = std::min(out, step->speed);
  return out;
}

/// The next larger of 1, 2, 5, 10, 20 ..., as cells are sold.
double next_cell(double load) {
  const double decade = std::pow(10.0, std::floor(std::log10(load)));
  for (const double step : {1.0, 2.0, 5.0})
    if (load <= step * decade) return step * decade;
  return 10.0 * decade;
}

/// The tension that a strand bears at most; of a material that says nothing about it, that at which it is twice as
/// long. The weaker of two ropes bears at least half of the load, and parts before the stronger one shows its strength.
double strength(const Material& material) {
  const double own = material.breaking_force.value_or(material.stretching_stiffness);
  return material.other ? std::min(own, strength(*material.other)) : own;
}

double capacity(const Material& material, const Method* known) {
  const double asked = known ? std::max(known->ends.load.value_or(0.0), largest(known->program, "N")) : 0.0;
  const double load = std::max(kMarginOfCell * strength(material), asked);
  return std::min(next_cell(std::max(load, kLeastCapacity)), kLargestCapacity);
}

/// The values that `auto` stands for in a method. They are the lengths and speeds of the source paper's test, whose
/// rods have a radius of 3.175 mm, scaled with the radius of the rod. A default therefore suits a thread as well as a
/// hawser. Values that the method sets have precedence: where two values must go together and only one is set, the
/// default of the other one is adapted to it.
struct Defaults {
  SpecimenOptions specimen;
  MachineOptions machine;       ///< its load cell has a suitable capacity and no name
  double scale = 1.0;           ///< radius of the rod over that of the paper's rods; speeds are scaled by it, too [-]
  double way = 0.0;             ///< extension of a pull whose `until.extension` is auto [m]
  double slip_tolerance = 0.0;  ///< slip tolerance of a friction law that creeps [m/s]
};

/// The defaults for a knot of this material. `known`: the method as it was read with the defaults of knot and material
/// alone; null while it has not been read.
Defaults defaults(const SpecimenOptions& specimen, const Material& material, const Method* known) {
  const double h = thickest(material), r = h / kPaperRadius;
  Defaults out;
  out.scale = r;
  const Knot& knot = knot_of(specimen);
  out.specimen = knot.defaults(h);
  out.specimen.knot = specimen.knot;
  out.specimen.drawing = specimen.drawing;
  out.machine.roller_diameter = knot.roller_diameter(h).value_or(out.machine.roller_diameter);
  if (specimen.drawing && !specimen.drawing->posts.empty()) out.machine.roller_friction = material.friction_coefficient;
  if (known) knot.suit(known->specimen, known->machine.roller_diameter, h, out.specimen);
  out.way = knot.pull(known ? known->specimen : out.specimen, h);
  const double asked = known ? largest(known->program, "m") : out.way;
  out.machine.travel = std::min(std::max({kLeastTravel, kLeastTravel * r, kTravelOverWay * asked}), kLargestTravel);
  out.machine.load_cell.capacity = capacity(material, known);
  out.slip_tolerance = kCreep * slowest_pull(known ? known->program : Program{}, r);
  return out;
}

/// Reads the map of a material or a load cell, which is called `otherwise` where it has no name.
template <class Options>
void read_named(Reader reader, void (&keys)(Fields&, Options&), const std::string& otherwise, Options& out) {
  keys(reader, out);
  reader.finish();
  if (out.name.empty()) out.name = otherwise;
}

/// `key`: that of the method.
Material read_material(const std::string& key, const YAML::Node& node, const std::string& file,
                       const ConfigLibrary& library) {
  Material material;
  if (!node.IsDefined() || node.IsNull()) throw InvalidInput::missing(key, library.allowed("materials")).in_file(file);
  if (!node.IsScalar() && !node.IsMap()) throw InvalidInput(file, key, as_given(node), library.allowed("materials"));
  if (node.IsMap()) {
    read_named(Reader(node, file, key), fields::material, "own", material);
  } else {
    const fs::path path = library.find("materials", node.Scalar(), key);
    read_named(Reader(read_yaml(path), path.string(), "", "a material"), fields::material, path.stem().string(),
               material);
  }
  return material;
}

LoadCellOptions read_load_cell(const YAML::Node& node, const std::string& file, const Material& material,
                               const LoadCellOptions& by_default, const ConfigLibrary& library,
                               std::vector<std::string>& automatic) {
  const std::string key = "machine.load_cell";
  LoadCellOptions cell = by_default;
  if (node.IsSequence()) throw InvalidInput(file, key, as_given(node), library.allowed("load_cells"));
  if (node.IsDefined() && node.IsMap()) {
    Reader reader(node, file, key);
    reader.note_automatic(automatic);
    read_named(reader, fields::load_cell, "own", cell);
  } else if (const std::optional<std::string> name = load_cell_name(node, material.load_cell)) {
    const fs::path path = library.find("load_cells", *name, key);
    read_named(Reader(read_yaml(path), path.string(), "", "a load cell"), fields::load_cell, path.stem().string(),
               cell);
  } else {
    cell.name = "auto";
    automatic.push_back(key + ".capacity");
  }
  return cell;
}

/// Notes the keys that are `automatic`.
Program read_program(const YAML::Node& node, const std::string& file, const Material& material,
                     const Defaults& defaults, std::vector<std::string>& automatic) {
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
  const Defaults auto_values = defaults(method.specimen, method.material, known);
  method.specimen = auto_values.specimen;
  fields::specimen(specimen, method.specimen);
  specimen.finish();
  method.machine = auto_values.machine;
  Reader machine = top.in("machine");
  fields::machine(machine, method.machine);
  method.machine.load_cell = read_load_cell(machine.take("load_cell"), file, method.material,
                                            auto_values.machine.load_cell, library, automatic);
  machine.finish();
  method.program = read_program(top.take("program"), file, method.material, auto_values, automatic);
  if (known) set_creep(known->physics.friction.law, auto_values.slip_tolerance, method.physics.friction);
  fields::behind_program(top, method);
  method.specification = read_specification(top.take("specification"), file);
  bool usual_scatter = true;
  method.specimens = read_specimens(top.take("specimens"), file, usual_scatter);
  if (usual_scatter) method.specimens.scatter = default_scatter(method);
  method.automatic = read_automatic(top.take("automatic"), file);
  top.finish();
  return method;
}

/// Keys without effect hold placeholders; writing them would misstate the test.
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
      throw InvalidInput("the file", kind_of(root), "a map with the keys specimen, material, machine and program");
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
