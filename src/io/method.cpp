#include "knot_utm/io/method.hpp"

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "knot_utm/io/curve_file.hpp"
#include "knot_utm/io/run_writer.hpp"
#include "knot_utm/io/shipped.hpp"
#include "knot_utm/numeric/known_names.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "method_defaults.hpp"
#include "method_fields.hpp"
#include "method_reader.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using fields::as_given;
using fields::one_line;
using fields::Reader;
using fields::Writer;

/// From which load on a fall may be a break, unless the method says so: testing machines have such a share.
constexpr double kArmingShare = 0.02;  // of the cell's capacity

/// Methods, materials and load cells are a few thousand characters long.
constexpr std::size_t kLongestText = 65536;

/// What is wrong with a text that is not YAML, where the parser's own words need knowledge of YAML's grammar.
std::string yaml_fault(const YAML::Exception& fault) {
  if (dynamic_cast<const YAML::DeepRecursion*>(&fault) != nullptr) return "maps and lists are nested too deeply";
  namespace Said = YAML::ErrorMsg;
  static const std::map<std::string, std::string> kPlain{
      {Said::END_OF_SEQ_FLOW, "a list begins with \"[\" and has no \"]\""},
      {Said::END_OF_MAP_FLOW, "a map begins with \"{\" and has no \"}\""},
      {Said::FLOW_END, "a \"]\" or \"}\" has nothing that it ends"},
      {Said::END_OF_MAP, "this line is neither a key of the map above it nor indented as a part of it"},
      {Said::END_OF_SEQ, "this line is neither an entry of the list above it nor indented as a part of it"},
      {Said::MAP_VALUE, "a colon stands where no value can begin; put text with a colon in quotes"},
      {Said::MAP_KEY, "a key stands where none can begin"},
      {Said::BLOCK_ENTRY, "a list begins with \"-\" where none can begin; put it on a line of its own"},
      {Said::EOF_IN_SCALAR, "the file ends within a text in quotes; a quote is missing"},
      {Said::TAB_IN_INDENTATION, "the line is indented by a tab; use blanks"},
      {Said::UNKNOWN_TOKEN, "a character stands here that YAML does not know here; put the text in quotes"},
      {Said::UNKNOWN_ANCHOR, "an alias (*name) has no anchor (&name) before it"}};
  const auto plain = kPlain.find(fault.msg);
  return plain == kPlain.end() ? shown(fault.msg) : plain->second;
}

YAML::Node parse_yaml(const std::string& text, const std::string& file) {
  if (text.size() > kLongestText) {
    const std::string most = std::to_string(kLongestText) + " characters";
    throw InvalidInput::sentence("file", file,
                                 "the file is longer than " + most + ", and no method, material or load cell is")
        .in_file(file);
  }
  try {
    return YAML::Load(text);
  } catch (const YAML::ParserException& parser) {
    const std::string place =
        "line " + std::to_string(parser.mark.line + 1) + ", column " + std::to_string(parser.mark.column + 1);
    throw InvalidInput::sentence(place, parser.msg, place + ": " + yaml_fault(parser)).in_file(file);
  }
}

std::string read_text(const fs::path& file) {
  std::error_code error;
  std::ifstream in;
  if (fs::is_regular_file(file, error)) in.open(file, std::ios::binary);
  if (!in.is_open()) throw InvalidInput::cannot_read(file.string());
  std::string text(kLongestText + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

YAML::Node read_yaml(const fs::path& file) { return parse_yaml(read_text(file), file.string()); }

/// Materials and load cells as files: where they are looked for, in order.
class Library {
 public:
  explicit Library(const fs::path& method_folder) {
    add(method_folder);
    add(method_folder / "config");
    add(method_folder / ".." / "config");
    add(fs::current_path());
    for (const std::string& folder : shipped_folders()) add(folder);
  }

  /// The names of the files of this kind, the folder "materials" or "load_cells", each once and in alphabetical order.
  std::vector<std::string> names(const std::string& kind) const {
    std::error_code error;
    std::set<std::string> known;
    for (const fs::path& folder : folders_) {
      for (fs::directory_iterator file(folder / kind, error), end; !error && file != end; file.increment(error)) {
        if (file->path().extension() == ".yaml") known.insert(file->path().stem().string());
      }
    }
    return {known.begin(), known.end()};
  }

  /// "a name (20N, 50kN) or a map".
  std::string allowed(const std::string& kind) const { return "a name (" + listed(names(kind), ", ") + ") or a map"; }

  /// `key` is what named the file, for the message.
  fs::path find(const std::string& kind, const std::string& name, const std::string& key) const {
    std::error_code error;
    for (const fs::path& folder : folders_) {
      for (const fs::path& candidate : {folder / kind / (name + ".yaml"), folder / name}) {
        if (!name.empty() && fs::is_regular_file(candidate, error)) return candidate;
      }
    }
    const fs::path file(name);
    if (file.has_parent_path() || file.extension() == ".yaml") throw InvalidInput::cannot_read(name, key);
    throw InvalidInput::unknown_name(key, name, allowed(kind), names(kind));
  }

 private:
  void add(const fs::path& folder) {
    std::error_code error;
    if (fs::is_directory(folder, error)) folders_.push_back(folder.lexically_normal());
  }

  std::vector<fs::path> folders_;
};

std::string material_name(const YAML::Node& root) {
  const YAML::Node node = root["material"];
  return node.IsDefined() && node.IsScalar() ? node.Scalar() : "";
}

/// A map read from a file with the file's name in it, so that it can stand in the method.
YAML::Node named_map(const fs::path& file) {
  YAML::Node map = read_yaml(file);
  if (map.IsMap() && !map["name"].IsDefined()) map["name"] = file.stem().string();
  return map;
}

/// The cell's name behind `auto`, or behind no entry at all; none where the material names no cell.
std::optional<std::string> load_cell_name(const YAML::Node& node, const std::string& of_material) {
  std::string given = node.IsDefined() && node.IsScalar() ? node.Scalar() : "auto";
  if (given != "auto") return given;
  return of_material.empty() ? std::nullopt : std::optional<std::string>(of_material);
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// No key of a method has more parts.
constexpr std::size_t kLongestPath = 8;

/// One `--set`.
struct Override {
  std::string key;
  std::vector<std::string> path;
  std::string text;

  /// Parsed anew each time: assigning a YAML::Node, as sorting would, changes the node behind it.
  YAML::Node value() const { return YAML::Load(text); }
};

Override parse_override(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos) {
    throw InvalidInput::sentence(
        "--set", text, "--set \"" + shown(text) + "\" sets no key: write key=value, such as specimen.preload=20");
  }
  Override set;
  set.key = text.substr(0, equals);
  set.path = split(set.key);
  set.text = text.substr(equals + 1);
  if (set.path.size() > kLongestPath) {
    const std::string most = std::to_string(kLongestPath) + " parts";
    throw InvalidInput::sentence("--set", text,
                                 "--set " + shown(set.key) + ": no key of a method has more than " + most);
  }
  try {
    set.value();
  } catch (const YAML::Exception& yaml) {
    throw InvalidInput::sentence("--set", text,
                                 "--set " + shown(text) + ": the value is not YAML: " + yaml_fault(yaml));
  }
  return set;
}

/// Puts the files behind `material` and `machine.load_cell` in place of their names when a key inside is to change.
void expand(YAML::Node root, const Override& set, const Library& library) {
  if (set.path.size() >= 2 && set.path[0] == "material" && !material_name(root).empty()) {
    root["material"] = named_map(library.find("materials", material_name(root), "material"));
  }
  if (set.path.size() >= 3 && set.path[0] == "machine" && set.path[1] == "load_cell") {
    const YAML::Node machine = root["machine"];
    const YAML::Node cell = machine.IsDefined() && machine.IsMap() ? machine["load_cell"] : YAML::Node();
    if (cell.IsDefined() && cell.IsMap()) return;
    YAML::Node material = root["material"];
    if (!material_name(root).empty()) {
      material = read_yaml(library.find("materials", material_name(root), "material"));
    }
    const YAML::Node of_material = material.IsDefined() && material.IsMap() ? material["load_cell"] : YAML::Node();
    const std::optional<std::string> name =
        load_cell_name(cell, of_material.IsDefined() && of_material.IsScalar() ? of_material.Scalar() : "");
    root["machine"]["load_cell"] =
        name ? named_map(library.find("load_cells", *name, "machine.load_cell")) : YAML::Node(YAML::NodeType::Map);
  }
}

/// The entry of a list that a part of a path means: its number, or the name of its only step of that name.
std::optional<std::size_t> entry(const YAML::Node& list, const std::string& part) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (part == std::to_string(i)) return i;
    if (list[i].IsMap() && list[i][part].IsDefined()) {
      if (found) return std::nullopt;
      found = i;
    }
  }
  return found;
}

void put(YAML::Node parent, const Override& set, std::size_t depth) {
  const std::string& part = set.path[depth];
  const bool last = depth + 1 == set.path.size();
  if (parent.IsSequence()) {
    const std::optional<std::size_t> index = entry(parent, part);
    if (!index) {
      const std::string last_entry = std::to_string(parent.size() == 0 ? 0 : parent.size() - 1);
      throw InvalidInput::sentence(set.key, one_line(set.value()),
                                   shown(set.key) + ": \"" + shown(part) + "\" is no single entry of " +
                                       (depth == 0 ? "the list" : shown(set.path[depth - 1])) +
                                       ": give a number from 0 to " + last_entry +
                                       ", or the name of a step that stands there once");
    }
    if (part != std::to_string(*index)) {
      put(parent[*index], set, depth);
    } else if (last) {
      parent[*index] = set.value();
    } else {
      put(parent[*index], set, depth + 1);
    }
    return;
  }
  if (!parent.IsMap() && !parent.IsNull()) {
    throw InvalidInput::sentence(set.key, one_line(set.value()),
                                 shown(set.key) + " is no key of a method: " + shown(set.path[depth - 1]) +
                                     " is a single value and has no keys");
  }
  if (last) {
    parent[part] = set.value();
  } else {
    if (!parent[part].IsDefined() || parent[part].IsNull()) parent[part] = YAML::Node(YAML::NodeType::Map);
    put(parent[part], set, depth + 1);
  }
}

void apply_overrides(YAML::Node root, const std::vector<std::string>& overrides, const Library& library) {
  std::vector<Override> sets;
  sets.reserve(overrides.size());
  for (const std::string& text : overrides) sets.push_back(parse_override(text));
  // A whole section is put in place before single keys inside it.
  std::stable_sort(sets.begin(), sets.end(),
                   [](const Override& a, const Override& b) { return a.path.size() < b.path.size(); });
  for (const Override& set : sets) {
    expand(root, set, library);
    put(root, set, 0);
  }
}

Material read_material(const YAML::Node& node, const std::string& file, const Library& library) {
  Material material;
  if (!node.IsDefined() || node.IsNull()) {
    throw InvalidInput::missing("material", library.allowed("materials")).in_file(file);
  }
  if (!node.IsScalar() && !node.IsMap())
    throw InvalidInput(file, "material", as_given(node), library.allowed("materials"));
  if (node.IsScalar()) {
    const fs::path path = library.find("materials", node.Scalar(), "material");
    Reader reader(read_yaml(path), path.string(), "", "a material");
    fields::material(reader, material);
    reader.finish();
    if (material.name.empty()) material.name = path.stem().string();
  } else {
    Reader reader(node, file, "material");
    fields::material(reader, material);
    reader.finish();
    if (material.name.empty()) material.name = "own";
  }
  return material;
}

LoadCellOptions read_load_cell(const YAML::Node& node, const std::string& file, const Material& material,
                               const LoadCellOptions& by_default, const Library& library) {
  LoadCellOptions cell = by_default;
  const std::optional<std::string> name = load_cell_name(node, material.load_cell);
  if (node.IsSequence()) throw InvalidInput(file, "machine.load_cell", as_given(node), library.allowed("load_cells"));
  if (node.IsDefined() && !node.IsNull() && !node.IsScalar()) {
    Reader reader(node, file, "machine.load_cell");
    fields::load_cell(reader, cell);
    reader.finish();
    if (cell.name.empty()) cell.name = "own";
  } else if (!name) {
    cell.name = "auto";
  } else {
    const fs::path path = library.find("load_cells", *name, "machine.load_cell");
    Reader reader(read_yaml(path), path.string(), "", "a load cell");
    fields::load_cell(reader, cell);
    reader.finish();
    if (cell.name.empty()) cell.name = path.stem().string();
  }
  return cell;
}

ProgramStep default_step(Phase phase, double scale) {
  ProgramStep step;
  step.phase = phase;
  step.speed *= scale;
  if (phase == Phase::kTie) step.speed = 0.01 * scale;
  if (phase == Phase::kRelease) step.duration = 3.0;
  return step;
}

Program read_program(const YAML::Node& node, const std::string& file, const fields::Defaults& defaults) {
  const std::vector<std::string> steps{"tie",  "release", "mount", "preload", "balance",
                                       "pull", "hold",    "cycle", "return",  "follow"};
  const std::string form = "a list of steps, such as [{pull: {until: {break: true}}}]";
  if (!node.IsDefined() || node.IsNull()) throw InvalidInput::missing("program", form).in_file(file);
  if (!node.IsSequence() || node.size() == 0) throw InvalidInput(file, "program", as_given(node), form);
  Program program;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string path = "program." + std::to_string(i);
    if (!node[i].IsMap() || node[i].size() != 1)
      throw InvalidInput(file, path, as_given(node[i]), "one step, {NAME: {...}}, where NAME is " + listed(steps));
    const std::string name = one_line(node[i].begin()->first);
    if (std::find(steps.begin(), steps.end(), name) == steps.end())
      throw InvalidInput::unknown_name(path, name, listed(steps), steps).in_file(file);
    ProgramStep step = default_step(*phase_named(name), defaults.scale);
    Reader reader(node[i].begin()->second, file, path + "." + name);
    fields::step(reader, step, defaults.way);
    reader.finish();
    program.push_back(step);
  }
  return program;
}

Specification read_specification(const YAML::Node& node, const std::string& file) {
  const std::string key = "specification";
  Specification specification;
  if (!node.IsDefined() || node.IsNull()) return specification;
  if (!node.IsMap())
    throw InvalidInput(file, key, as_given(node), "a map such as {peak_force: {min: 100}}, of numbers of result.yaml");
  const std::vector<std::string> known = result_numbers();
  for (const auto& item : node) {
    Requirement required;
    required.key = one_line(item.first);
    const std::string path = key + "." + required.key;
    const auto is_it = [&](const Requirement& other) { return other.key == required.key; };
    if (std::find(known.begin(), known.end(), required.key) == known.end())
      throw InvalidInput::unknown_key(key, required.key, one_line(item.second), known, "a specification").in_file(file);
    if (std::any_of(specification.begin(), specification.end(), is_it))
      throw InvalidInput::sentence(path, one_line(item.second), shown(path) + " stands twice; give it once")
          .in_file(file);
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

/// The course of the crosshead in the record of another test, curve.csv or raw data.
void read_record(const fs::path& folder, const std::string& follow, ProgramStep& step) {
  const std::string key = follow + ".record";
  std::error_code error;
  const fs::path file = fs::absolute(folder / step.record).lexically_normal();
  if (step.record.empty()) throw InvalidInput::missing(key, "a curve.csv, or raw data of a testing machine");
  if (!fs::is_regular_file(file, error)) throw InvalidInput::cannot_read(file.string(), key);
  step.record = file.string();
  step.recorded.clear();
  RawColumns columns;
  if (!step.columns.empty()) columns = parse_raw_columns(step.columns, follow + ".columns");
  const std::vector<CurveRow> course = read_course(step.record, columns);
  for (const CurveRow& row : course) {
    const RecordedPlace place{row.time - course.front().time, row.extension - course.front().extension};
    if (step.recorded.empty() || place.time > step.recorded.back().time) step.recorded.push_back(place);
  }
  if (step.recorded.size() < 2)
    throw InvalidInput::sentence(
        key, step.record,
        key + ": " + shown(step.record) + " has fewer than 2 readings of the pull at different times");
}

/// The speed with which friction may creep, where its law has one.
void set_creep(FrictionLaw law, double speed, FrictionOptions& friction) {
  for (const FrictionKey& key : friction_keys())
    if (key.otherwise == FrictionDefault::kCreep && entry_of(law).has(key.name)) friction.set(key.name, speed);
}

/// The method over defaults that suit its knot and material, and, once it has been read with these, what is `known` of
/// the rest.
Method read_method(const YAML::Node& root, const std::string& file, const Library& library, const Method* known) {
  Method method;
  Reader top(root, file, "");
  method.material = read_material(top.take("material"), file, library);
  Reader specimen(top.take("specimen"), file, "specimen");
  fields::knot(specimen, method.specimen.knot);
  const fields::Defaults defaults = fields::defaults(method.specimen.knot, method.material, known);
  method.specimen = defaults.specimen;
  fields::specimen(specimen, method.specimen);
  specimen.finish();
  method.machine = defaults.machine;
  top.section("machine", [&](Reader& reader) {
    fields::machine(reader, method.machine);
    method.machine.load_cell =
        read_load_cell(reader.take("load_cell"), file, method.material, defaults.machine.load_cell, library);
  });
  method.program = read_program(top.take("program"), file, defaults);
  // Without effect they keep their plain value.
  if (known && known->ends.breaks.drop) method.ends.breaks.drop_extension = defaults.drop_extension;
  if (known) set_creep(known->physics.friction.law, defaults.slip_tolerance, method.physics.friction);
  top.section("ends", [&](Reader& reader) { fields::ends(reader, method.ends); });
  top.section("physics", [&](Reader& reader) { fields::physics(reader, method.physics); });
  top.section("analysis", [&](Reader& reader) { fields::analysis(reader, method.analysis); });
  top.section("report", [&](Reader& reader) { fields::report(reader, method.report); });
  method.specification = read_specification(top.take("specification"), file);
  top.finish();
  return method;
}

}  // namespace

Method load_method(const std::string& file, const std::vector<std::string>& overrides) {
  return parse_method(read_text(file), file, overrides);
}

Method parse_method(const std::string& text, const std::string& file, const std::vector<std::string>& overrides) {
  const fs::path path(file);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  YAML::Node root = parse_yaml(text, file);
  try {
    const Library library(folder);
    if (!root.IsMap())
      throw InvalidInput("the file", as_given(root), "a map with the keys specimen, material, machine and program");
    apply_overrides(root, overrides, library);

    const Method first = read_method(root, file, library, nullptr);
    Method method = read_method(root, file, library, &first);
    method.name = path.stem().string();
    method.specimen.to_be_tied = std::any_of(method.program.begin(), method.program.end(),
                                             [](const ProgramStep& step) { return step.phase == Phase::kTie; });

    const Material& material = method.material;
    if (!method.specimen.preload && knot_of(method.specimen).has("preload")) {
      method.specimen.preload = default_preload(material);
    }
    if (!method.specimen.file.empty()) {
      method.specimen.file = fs::absolute(folder / method.specimen.file).lexically_normal().string();
    }
    if (!method.report.logo.empty())
      method.report.logo = fs::absolute(folder / method.report.logo).lexically_normal().string();
    for (std::size_t i = 0; i < method.program.size(); ++i)
      if (method.program[i].phase == Phase::kFollow)
        read_record(folder, "program." + std::to_string(i) + ".follow", method.program[i]);
    check_method(method);
    return method;
  } catch (const InvalidInput& invalid) {
    throw invalid.in_file(file);
  } catch (const YAML::Exception& yaml) {
    throw InvalidInput::sentence("the file", yaml.msg, "the file is no method: " + yaml_fault(yaml)).in_file(file);
  }
}

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
  YAML::Emitter out;
  out << root;
  return std::string(out.c_str()) + "\n";
}

namespace {

/// Half the windows within which a drop of the load counts as a break, so that they are resolved [s].
double longest_period(const Method& method) {
  const BreakDetection& breaks = method.ends.breaks;
  double window = fields::kInfinity;
  if (breaks.sharp_drop) window = breaks.sharp_drop_time;
  if (breaks.drop)
    for (const ProgramStep& step : method.program) window = std::min(window, breaks.drop_extension / step.speed);
  return 0.5 * window;
}

}  // namespace

ProgramRunner make_program(const Method& method, double longest_step) {
  ProgramRunner::Limits limits;
  const double capacity = method.machine.load_cell.capacity;
  const MachineOptions& machine = method.machine;
  const double h = method.material.radius;
  limits.load = method.ends.load.value_or(capacity);
  limits.least_distance = (machine.grips == GripKind::kRollers ? machine.roller_diameter : 0.0) + 2.0 * h;
  limits.travel = method.machine.travel;
  limits.time = method.ends.time.value_or(limits.time);
  limits.breaks = method.ends.breaks;
  limits.breaks.arming_load = method.ends.arming_load.value_or(kArmingShare * capacity);
  return ProgramRunner(method.program, machine.load_cell.sampling_rate, std::min(longest_step, longest_period(method)),
                       limits);
}

}  // namespace knot_utm
