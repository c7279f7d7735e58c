#include "knot_utm/method/method_keys.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "knot_utm/program/program.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "method_fields.hpp"

namespace knot_utm {
namespace {

using fields::Fields;
using fields::LowHigh;
using fields::Range;
using fields::Unset;

/// A key of a method that a walk over its fields came by.
struct WalkedKey : KeyUnit {
  bool number;
};

/// Keeps the keys.
class KeyWalk : public Fields {
 public:
  KeyWalk(std::string path, std::vector<WalkedKey>& found) : path_(std::move(path)), found_(found) {}

  void optional_number(const char* key, std::optional<double>& value, const Range& range, const char*,
                       std::optional<double> = {}) override {
    add_number(key, range.unit, value);
  }
  void text(const char* key, std::string&, std::size_t = kAnyLength) override { add_other(key); }
  void flag(const char* key, bool&) override { add_other(key); }
  void vector(const char* key, Eigen::Vector3d& value, const Range& range) override {
    add_list(key, {value.begin(), value.end()}, range);
  }
  void low_high(const char* key, std::optional<LowHigh>& value, const Range& range) override {
    if (value)
      add_list(key, {value->low, value->high}, range);
    else
      add_list(key, {std::nullopt, std::nullopt}, range);
  }
  void section(const char* key, const std::function<void(Fields&)>& body) override {
    KeyWalk inner(path_ + key + ".", found_);
    body(inner);
  }
  bool lists_all() const override { return true; }

 private:
  void visit_number(const char* key, double& value, const Range& range, Unset) override {
    add_number(key, range.unit, value);
  }
  void visit_number_or_word(const char* key, std::optional<double>& value, const Range& range, std::size_t&,
                            const std::vector<std::string>&) override {
    add_number(key, range.unit, value);
  }
  void visit_whole_number(const char* key, double& value, double, double) override { add_number(key, "-", value); }
  void visit_name(const char* key, std::size_t&, const std::vector<std::string>&) override { add_other(key); }

  void add_list(const std::string& key, const std::vector<std::optional<double>>& values, const Range& range) {
    add_number(key, range.unit, std::nullopt);
    for (std::size_t i = 0; i < values.size(); ++i) add_number(key + "." + std::to_string(i), range.unit, values[i]);
  }
  void add_number(const std::string& key, const char* unit, std::optional<double> value) {
    found_.push_back({{path_ + key, unit, value}, true});
  }
  void add_other(const char* key) { found_.push_back({{path_ + key, "-", std::nullopt}, false}); }

  std::string path_;
  std::vector<WalkedKey>& found_;
};

std::vector<WalkedKey> walked_keys(const Method& method) {
  Method m = method;
  std::vector<WalkedKey> found;
  KeyWalk top("", found);
  fields::before_program(top, m);
  for (std::size_t i = 0; i < m.program.size(); ++i) {
    const std::string name = m.program[i]->name();
    std::vector<std::string> names{std::to_string(i) + "." + name};
    if (step_called(m.program, name)) names.push_back(name);
    for (const std::string& entry : names) {
      KeyWalk step("program." + entry + ".", found);
      m.program[i]->keys(step, 0.0);
    }
  }
  fields::behind_program(top, m);
  return found;
}

struct Label {
  const char* key;
  const char* words;
};

/// These keys have labels, because their names alone would not tell a reader enough.
constexpr Label kLabels[] = {
    {"specimen.handedness", "Handedness of the two overhands"},
    {"specimen.file", "Shape from"},
    {"specimen.knot_distance", "Knot distance e"},
    {"specimen.end_to_end", "End to end L"},
    {"specimen.length", "Length of rod"},
    {"specimen.tail", "Tails"},
    {"specimen.preload", "Pre-load F_p"},
    {"specimen.wrap", "Angle around the post"},
    {"specimen.natural_curvature", "Natural curvature"},
    {"specimen.edge_length", "Edge length of the mesh"},
    {"specimen.refinement", "Refinement within the knots"},
    {"material.rolling_resistance", "Resistance of contacts to rolling"},
    {"material.rolling_hysteresis", "Work lost as a soft contact rolls"},
    {"material.section", "Cross-section: round, or soft: flattened and thinned"},
    {"material.friction_couple", "Friction's couple: 1 at the surface, 0 on the centreline"},
    {"material.hardening", "Share of the bending stiffness that does not yield"},
    {"material.friction_moment", "Friction moment of a bent rope"},
    {"material.stick_ratio", "Stiffness of a bend before fibres slide"},
    {"material.compaction", "Friction moment by tension borne"},
    {"material.breaking.law", "What parts the rod"},
    {"material.breaking.bending_share", "Share of its bend that a fibre bears"},
    {"material.breaking.crushing_share", "Strength lost by being pressed flat"},
    {"machine.far_side", "Far side of the loop"},
    {"machine.stiffness", "Frame stiffness"},
    {"machine.load_cell.capacity", "Capacity of the cell"},
    {"machine.load_cell.sampling_rate", "Readings of the cell"},
    {"machine.load_cell.accuracy", "Accuracy of the cell"},
    {"machine.load_cell.floor", "Floor of the cell"},
    {"machine.load_cell.resolution", "Resolution of the cell"},
    {"machine.load_cell.noise", "Noise of the cell, standard deviation"},
    {"ends.break_at_fraction_of_peak", "Break at no more than"},
    {"physics.friction.at", "Friction acts at the"},
    {"physics.friction.pair", "Friction of two materials"},
    {"physics.inertia", "Mass that is accelerated"},
    {"physics.max_step", "Longest step"},
};

/// The experimental keys, by their last part.
constexpr std::array kExperimental{"natural_curvature", "hardening", "noise_run", "load_rate",
                                   "break_at_fraction_of_peak"};

/// Whether a key belongs to an entry of a list, or to a step that goes by its number.
bool is_numbered(const std::string& key) {
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    if (key.find_first_not_of("0123456789", begin) >= end) return true;
    begin = end + 1;
  }
  return false;
}

/// The name of a key in words: "contact stiffness" of "material.contact_stiffness".
std::string words_of(const std::string& key) {
  std::string words = key.substr(key.rfind('.') + 1);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace

bool is_experimental(const std::string& key) {
  const std::string last = key.substr(key.rfind('.') + 1);
  return std::find(kExperimental.begin(), kExperimental.end(), last) != kExperimental.end();
}

std::vector<KeyUnit> key_units(const Method& method) {
  std::vector<KeyUnit> found;
  for (const WalkedKey& one : walked_keys(method))
    if (one.number) found.push_back(one);
  return found;
}

std::vector<KeyUnit> step_numbers(ProgramStep step, const std::string& path) {
  std::vector<WalkedKey> found;
  KeyWalk walk(path + ".", found);
  step->keys(walk, 0.0);
  return {found.begin(), found.end()};
}

std::string unit_of_key(const Method& method, const std::string& key) {
  for (const KeyUnit& one : key_units(method))
    if (one.key == key) return one.unit;
  return "";
}

std::vector<MethodKey> method_keys() {
  std::vector<MethodKey> keys;
  Method any;
  any.program = all_steps();
  for (const WalkedKey& one : walked_keys(any))
    if (!is_numbered(one.key)) keys.push_back({one.key, words_of(one.key), one.unit});
  for (const Label& label : kLabels) {
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const MethodKey& one) { return one.key == label.key; });
    if (key == keys.end()) throw std::logic_error(std::string(label.key) + " has a label, but is no key of a method");
    key->label = label.words;
  }
  const std::string others = "other_";
  for (MethodKey& key : keys) {
    if (key.key.rfind(others + "material.", 0) != 0) continue;
    const auto first = std::find_if(keys.begin(), keys.end(),
                                    [&](const MethodKey& one) { return one.key == key.key.substr(others.size()); });
    key.label = first->label + " of the other ropes";
  }
  return keys;
}

std::string method_keys_csv() {
  std::string all = "key,label,unit,experimental\n";
  for (const MethodKey& one : method_keys())
    all += one.key + ",\"" + one.label + "\"," + one.unit + (is_experimental(one.key) ? ",yes\n" : ",\n");
  return all;
}

std::string knots_csv() {
  // The mesh comes last.
  const char *const kEdges = "edge_length", *const kRefinement = "refinement";
  std::string all = "knot,title,keys\n";
  for (const Knot* knot : knots()) {
    const KnotDescription& about = knot->about();
    all += std::string(about.name) + ",\"" + about.title + "\",";
    for (const std::string& key : about.keys)
      if (key != kRefinement) all += key + " ";
    all += kEdges;
    if (knot->has(kRefinement)) all += std::string(" ") + kRefinement;
    all += "\n";
  }
  return all;
}

}  // namespace knot_utm
