#include "key_walk.hpp"

#include "method_fields.hpp"

namespace knot_utm {

namespace {

/// A `Fields` (method_fields.hpp) that keeps the keys.
class KeyWalk {
 public:
  KeyWalk(std::string path, std::vector<WalkedKey>& found) : path_(std::move(path)), found_(found) {}

  using Range = fields::Range;
  void number(const char* key, double&, const Range& range) { add_number(key, range.unit); }
  void scaled_number(const char* key, double&, const Range& range) { add_number(key, range.unit); }
  void required_number(const char* key, double&, const Range& range) { add_number(key, range.unit); }
  template <class... Words>
  void optional_number(const char* key, std::optional<double>&, const Range& range, Words...) {
    add_number(key, range.unit);
  }
  template <class Integer>
  void integer(const char* key, Integer&, Integer, Integer) {
    add_number(key, "-");
  }
  void text(const char* key, std::string&) { add_other(key); }
  void short_text(const char* key, std::string&, std::size_t) { add_other(key); }
  void flag(const char* key, bool&) { add_other(key); }
  template <class Enum, class Names>
  void choice(const char* key, Enum&, const Names&) {
    add_other(key);
  }
  void vector(const char* key, Eigen::Vector3d&, const Range& range) {
    for (const char* axis : {"", ".0", ".1", ".2"}) add_number(key + std::string(axis), range.unit);
  }
  void turns(const char* key, std::optional<TurningPoints>&, const Range& range) {
    for (const char* end : {"", ".0", ".1"}) add_number(key + std::string(end), range.unit);
  }
  template <class Body>
  void section(const char* key, Body body) {
    KeyWalk inner(path_ + key + ".", found_);
    body(inner);
  }

 private:
  void add_number(const std::string& key, const char* unit) { found_.push_back({path_ + key, unit, true}); }
  void add_other(const char* key) { found_.push_back({path_ + key, "-", false}); }

  std::string path_;
  std::vector<WalkedKey>& found_;
};

}  // namespace

std::vector<WalkedKey> walked_keys(const Method& method) {
  Method m = method;
  std::vector<WalkedKey> found;
  KeyWalk top("", found);
  top.section("specimen", [&](KeyWalk& f) { fields::specimen(f, m.specimen); });
  top.section("material", [&](KeyWalk& f) { fields::material(f, m.material); });
  top.section("machine", [&](KeyWalk& f) {
    fields::machine(f, m.machine);
    f.section("load_cell", [&](KeyWalk& cell) { fields::load_cell(cell, m.machine.load_cell); });
  });
  for (std::size_t i = 0; i < m.program.size(); ++i) {
    const std::string name = phase_name(m.program[i].phase);
    std::vector<std::string> names{std::to_string(i) + "." + name};
    if (step_called(m.program, name)) names.push_back(name);
    for (const std::string& entry : names) {
      KeyWalk step("program." + entry + ".", found);
      fields::step(step, m.program[i]);
    }
  }
  top.section("ends", [&](KeyWalk& f) { fields::ends(f, m.ends); });
  top.section("physics", [&](KeyWalk& f) { fields::physics(f, m.physics); });
  return found;
}

}  // namespace knot_utm
