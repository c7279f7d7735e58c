#include "knot_utm/io/key_units.hpp"

#include <cstddef>

#include "method_fields.hpp"

namespace knot_utm {

namespace {

/// Walks all keys of a method and keeps those of numbers, with their units.
class Numbers {
 public:
  Numbers(std::string path, std::vector<KeyUnit>& found) : path_(std::move(path)), found_(found) {}

  using Range = fields::Range;
  void number(const char* key, double&, const Range& range) { visit(key, range.unit); }
  void scaled_number(const char* key, double&, const Range& range) { visit(key, range.unit); }
  void required_number(const char* key, double&, const Range& range) { visit(key, range.unit); }
  template <class... Words>
  void optional_number(const char* key, std::optional<double>&, const Range& range, Words...) {
    visit(key, range.unit);
  }
  template <class Integer>
  void integer(const char* key, Integer&, Integer, Integer) {
    visit(key, "-");
  }
  void text(const char*, std::string&) {}
  void short_text(const char*, std::string&, std::size_t) {}
  void flag(const char*, bool&) {}
  template <class Enum, class Names>
  void choice(const char*, Enum&, const Names&) {}
  void vector(const char* key, Eigen::Vector3d&, const Range& range) {
    for (const char* axis : {"", ".0", ".1", ".2"}) visit((key + std::string(axis)).c_str(), range.unit);
  }
  void turns(const char* key, std::optional<TurningPoints>&, const Range& range) {
    for (const char* end : {"", ".0", ".1"}) visit((key + std::string(end)).c_str(), range.unit);
  }
  template <class Body>
  void section(const char* key, Body body) {
    Numbers inner(path_ + key + ".", found_);
    body(inner);
  }

 private:
  void visit(const char* key, const char* unit) { found_.push_back({path_ + key, unit}); }

  std::string path_;
  std::vector<KeyUnit>& found_;
};

}  // namespace

std::vector<KeyUnit> key_units(const Method& method) {
  Method m = method;
  std::vector<KeyUnit> found;
  Numbers top("", found);
  top.section("specimen", [&](Numbers& f) { fields::specimen(f, m.specimen); });
  top.section("material", [&](Numbers& f) { fields::material(f, m.material); });
  top.section("machine", [&](Numbers& f) {
    fields::machine(f, m.machine);
    f.section("load_cell", [&](Numbers& cell) { fields::load_cell(cell, m.machine.load_cell); });
  });
  for (std::size_t i = 0; i < m.program.size(); ++i) {
    const std::string name = phase_name(m.program[i].phase);
    std::vector<std::string> names{std::to_string(i) + "." + name};
    if (step_called(m.program, name)) names.push_back(name);
    for (const std::string& entry : names) {
      Numbers step("program." + entry + ".", found);
      fields::step(step, m.program[i]);
    }
  }
  top.section("ends", [&](Numbers& f) { fields::ends(f, m.ends); });
  top.section("physics", [&](Numbers& f) { fields::physics(f, m.physics); });
  return found;
}

std::string unit_of_key(const Method& method, const std::string& key) {
  for (const KeyUnit& one : key_units(method))
    if (one.key == key) return one.unit;
  return "";
}

}  // namespace knot_utm
