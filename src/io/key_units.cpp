#include "knot_utm/io/key_units.hpp"

#include <cstddef>

#include "method_fields.hpp"

namespace knot_utm {

namespace {

/// Walks all keys of a method and keeps the unit of one of them.
class UnitOfKey {
 public:
  UnitOfKey(const std::string& wanted, std::string path, std::string& unit)
      : wanted_(wanted), path_(std::move(path)), unit_(unit) {}

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
    for (const char* axis : {".0", ".1", ".2"}) visit((key + std::string(axis)).c_str(), range.unit);
  }
  void turns(const char* key, std::optional<TurningPoints>&, const Range& range) {
    for (const char* end : {".0", ".1"}) visit((key + std::string(end)).c_str(), range.unit);
  }
  template <class Body>
  void section(const char* key, Body body) {
    UnitOfKey inner(wanted_, path_ + key + ".", unit_);
    body(inner);
  }

 private:
  void visit(const char* key, const char* unit) {
    if (path_ + key == wanted_) unit_ = unit;
  }

  const std::string& wanted_;
  std::string path_;
  std::string& unit_;
};

}  // namespace

std::string unit_of_key(const Method& method, const std::string& key) {
  Method m = method;
  std::string unit;
  UnitOfKey top(key, "", unit);
  top.section("specimen", [&](UnitOfKey& f) { fields::specimen(f, m.specimen); });
  top.section("material", [&](UnitOfKey& f) { fields::material(f, m.material); });
  top.section("machine", [&](UnitOfKey& f) {
    fields::machine(f, m.machine);
    f.section("load_cell", [&](UnitOfKey& cell) { fields::load_cell(cell, m.machine.load_cell); });
  });
  for (std::size_t i = 0; i < m.program.size(); ++i) {
    const std::string name = phase_name(m.program[i].phase);
    for (const std::string& entry : {name, std::to_string(i), std::to_string(i) + "." + name}) {
      UnitOfKey step(key, "program." + entry + ".", unit);
      fields::step(step, m.program[i]);
    }
  }
  top.section("ends", [&](UnitOfKey& f) { fields::ends(f, m.ends); });
  top.section("physics", [&](UnitOfKey& f) { fields::physics(f, m.physics); });
  return unit;
}

}  // namespace knot_utm
