#include <algorithm>
#include <array>
#include <cmath>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/tying/before_tying.hpp"
#include "knot_utm/words/number.hpp"
#include "method_parts.hpp"
#include "method_reader.hpp"

namespace knot_utm {
namespace {

using fields::one_line;
using fields::Range;
using fields::Reader;

/// A law, what a method calls it, and its spreads: a normal one stays positive up to its 3 standard deviations.
struct Law {
  ScatterLaw law;
  const char* name;
  Range range;
};
constexpr std::array<Law, 3> kLaws{{{ScatterLaw::kNormal, "normal", {1e-6, 0.3, "-"}},
                                    {ScatterLaw::kLogNormal, "log_normal", {1e-6, 1.0, "-"}},
                                    {ScatterLaw::kUniform, "uniform", {1e-6, 0.999, "-"}}}};

// As specimens that a person ties differ: chosen, as in bench/specimens.py. The distance of the knots and how loose an
// overhand is are set against a ruler, the tails by eye, the speed by hand, the pre-load by a machine.
constexpr double kByRuler = 0.01, kByEye = 0.05, kByHand = 0.1, kByMachine = 0.02;

Scatter read_scatter(const std::string& key, const YAML::Node& node, const std::string& file) {
  const std::string path = "specimens.scatter." + key;
  if (!node.IsMap() || node.size() != 1)
    throw InvalidInput(file, path, fields::as_given(node),
                       "one law and its spread, such as {normal: 0.05}; the laws are normal, log_normal and uniform");
  Reader reader(node, file, path);
  Scatter out;
  out.key = key;
  for (const Law& law : kLaws)
    if (node[law.name].IsDefined()) {
      reader.required_number(law.name, out.spread, law.range);
      out.law = law.law;
    } else {
      reader.take(law.name);  // so that a message lists it
    }
  reader.finish();
  return out;
}

}  // namespace

SpecimensOptions read_specimens(const YAML::Node& node, const std::string& file, bool& automatic) {
  SpecimensOptions out;
  automatic = true;
  if (!node.IsDefined() || node.IsNull()) return out;
  Reader reader(node, file, "specimens");
  reader.integer("count", out.count, 1, kMostSpecimens);
  reader.integer("seed", out.seed, 0u, std::numeric_limits<unsigned>::max());
  const YAML::Node scatter = reader.take("scatter");
  reader.finish();
  if (!scatter.IsDefined() || scatter.IsNull() || (scatter.IsScalar() && scatter.Scalar() == "auto")) return out;
  automatic = false;
  if (scatter.IsScalar() && scatter.Scalar() == "none") return out;
  if (!scatter.IsMap())
    throw InvalidInput(file, "specimens.scatter", fields::as_given(scatter),
                       "auto, none, or a map of keys such as {specimen.tail: {normal: 0.05}}");
  for (const auto& item : scatter) {
    const std::string key = one_line(item.first);
    if (std::any_of(out.scatter.begin(), out.scatter.end(), [&](const Scatter& other) { return other.key == key; }))
      throw InvalidInput::sentence("specimens.scatter",
                                   "specimens.scatter: " + shown(key) + " stands twice; give it once")
          .in_file(file);
    out.scatter.push_back(read_scatter(key, item.second, file));
  }
  return out;
}

std::vector<Scatter> default_scatter(const Method& method) {
  const Knot& knot = knot_of(method.specimen);
  std::vector<Scatter> out;
  const auto add = [&](const char* key, double spread) { out.push_back({key, ScatterLaw::kNormal, spread}); };
  if (knot.has("knot_distance")) {
    add("specimen.knot_distance", kByRuler);
    add("specimen.tail", kByEye);
  } else if (knot.about().tied_by_ends) {
    add("specimen.end_to_end", kByRuler);
    add("specimen.tail", kByEye);
  } else if (knot.about().knots > 0 && knot.has("end_to_end")) {
    add("specimen.end_to_end", kByRuler);
  }
  if (has_step<TieStep>(method.program)) {
    if (preload_acts(method.specimen)) add("specimen.preload", kByMachine);
    add("program.tie.speed", kByHand);
  }
  return out;
}

void check_scatter(const Method& method) {
  for (const Scatter& scatter : method.specimens.scatter) {
    const std::optional<double> value = number_at(method, scatter.key);
    const std::string begin = "specimens.scatter: " + shown(scatter.key);
    if (!value)
      throw InvalidInput::sentence("specimens.scatter",
                                   begin +
                                       " is no key of this method that has a number, such as material.radius or "
                                       "program.pull.speed");
    if (!std::isfinite(*value) || *value == 0.0)
      throw InvalidInput::sentence("specimens.scatter",
                                   begin + " is " + format_number(*value) +
                                       " in this method, which does not scatter: what is drawn is a fraction of it");
  }
}

YAML::Node specimens_map(const SpecimensOptions& specimens) {
  YAML::Node map;
  map["count"] = std::to_string(specimens.count);
  map["seed"] = std::to_string(specimens.seed);
  if (specimens.scatter.empty()) {
    map["scatter"] = "none";
    return map;
  }
  for (const Scatter& scatter : specimens.scatter) {
    YAML::Node law;
    law[std::find_if(kLaws.begin(), kLaws.end(), [&](const Law& one) { return one.law == scatter.law; })->name] =
        format_yaml_number(scatter.spread);
    law.SetStyle(YAML::EmitterStyle::Flow);
    map["scatter"][scatter.key] = law;
  }
  return map;
}

}  // namespace knot_utm
