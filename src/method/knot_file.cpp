#include "knot_utm/method/knot_file.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "config_library.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/per_knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "method_reader.hpp"

namespace knot_utm {
namespace {

using fields::as_given;
using fields::one_line;
using fields::Reader;

constexpr double kFarthest = 200.0;  // coordinate of a point [h]
constexpr double kLeastStep = 0.1;   // from a point to the next [h]
// Radius of a hole: a strand that fills it is as near to all sections of its ring, and touches none of them rightly
// [h].
constexpr double kNarrowestHole = 1.02;
constexpr double kOffAxis = 1e-3;  // of the two last points of a held end: they lie along z [h]
constexpr std::size_t kFewestPoints = 3, kMostPoints = 2000;

/// Reads the lists of a knot's file, and refuses what is none.
class KnotReader {
 public:
  explicit KnotReader(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void refuse(const std::string& key, const YAML::Node& value, const std::string& allowed) const {
    throw InvalidInput(file_, key, as_given(value), allowed);
  }
  [[noreturn]] void refuse(const std::string& key, const std::string& why) const {
    throw InvalidInput::sentence(key, key + ": " + why).in_file(file_);
  }

  double number(const std::string& key, const YAML::Node& node, double low, double high) const {
    const std::optional<double> value = node.IsScalar() ? parse_number(node.Scalar()) : std::nullopt;
    if (!value || !(*value >= low && *value <= high))
      refuse(key, node, "a number from " + format_number(low) + " to " + format_number(high));
    return *value;
  }

  Vec3 point(const std::string& key, const YAML::Node& node) const {
    if (!node.IsSequence() || node.size() != 3) refuse(key, node, "a list [x, y, z] in radii of the rod");
    Vec3 out;
    for (std::size_t i = 0; i < 3; ++i) out[static_cast<Eigen::Index>(i)] = number(key, node[i], -kFarthest, kFarthest);
    return out;
  }

  std::string name(const std::string& key, const YAML::Node& node, const char* what = "the name of an end") const {
    if (!node.IsScalar() || node.Scalar().empty()) refuse(key, node, what);
    require_one_line(key, node.Scalar());
    return node.Scalar();
  }

  void require_one_line(const std::string& key, const std::string& words) const {
    if (std::any_of(words.begin(), words.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
      refuse(key, "it must be one line of text, without control characters");
  }

  KnotDrawing::Strand strand(const std::string& key, const YAML::Node& node) const {
    Reader reader(node, file_, key, "a knot");
    KnotDrawing::Strand out;
    const YAML::Node ends = reader.take("ends"), points = reader.take("points");
    reader.finish();
    if (!ends.IsDefined() || !ends.IsSequence() || ends.size() != 2)
      refuse(key + ".ends", ends, "a list of two names, of the strand's first and last end");
    for (std::size_t i = 0; i < 2; ++i) out.ends[i] = name(key + ".ends", ends[i]);
    const bool enough = points.IsDefined() && points.IsSequence() && points.size() >= kFewestPoints;
    if (!enough || points.size() > kMostPoints)
      refuse(key + ".points", points, "a list of 3 to 2000 points [x, y, z] in radii of the rod");
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::string at = key + ".points." + std::to_string(i);
      const Vec3 next = point(at, points[i]);
      if (i > 0 && (next - out.points.back()).norm() < kLeastStep)
        refuse(at, "the same point as the one before it; leave it out");
      out.points.push_back(next);
    }
    return out;
  }

  KnotDrawing::Post post(const std::string& key, const YAML::Node& node) const {
    Reader reader(node, file_, key, "a knot");
    const YAML::Node through = reader.take("through"), along = reader.take("along"), radius = reader.take("radius"),
                     ring = reader.take("ring"), grip = reader.take("grip");
    reader.finish();
    KnotDrawing::Post out;
    out.through = point(key + ".through", through);
    out.along = point(key + ".along", along);
    if (out.along.norm() < kLeastStep) refuse(key + ".along", along, "a direction");
    out.along.normalize();
    out.radius = number(key + ".radius", radius, 0.5, kFarthest);
    if (ring.IsDefined()) out.ring = number(key + ".ring", ring, out.radius + kNarrowestHole, kFarthest);
    const std::string of = grip.IsDefined() && grip.IsScalar() ? grip.Scalar() : "lower";
    out.upper = of == "upper";
    if ((grip.IsDefined() && !grip.IsScalar()) || (!out.upper && of != "lower"))
      refuse(key + ".grip", grip, "lower, whose post stands still, or upper, whose post moves with it");
    return out;
  }

 private:
  std::string file_;
};

/// The items of a list; of none where the key is left out.
template <typename Read>
auto list_of(const KnotReader& reader, const char* key, const YAML::Node& node, const char* what, Read read) {
  std::vector<decltype(read(std::string(), node))> out;
  if (!node.IsDefined() || node.IsNull()) return out;
  if (!node.IsSequence()) reader.refuse(key, node, what);
  for (std::size_t i = 0; i < node.size(); ++i)
    out.push_back(read(std::string(key) + "." + std::to_string(i), node[i]));
  return out;
}

std::vector<std::string> ends_of(const KnotDrawing& knot) {
  std::vector<std::string> out;
  for (const KnotDrawing::Strand& strand : knot.strands) out.insert(out.end(), strand.ends.begin(), strand.ends.end());
  return out;
}

/// Landmarks, each a place of a strand, and what is read between them.
class LandmarkReader {
 public:
  LandmarkReader(const KnotReader& reader, KnotDrawing& knot) : reader_(reader), knot_(knot) {}

  void landmarks(const YAML::Node& node) {
    for (const auto& [name, place] : named("landmarks", node, "a map such as {eye: [0, 17]}")) {
      const std::string key = "landmarks." + name;
      if (!place.IsSequence() || place.size() != 2)
        reader_.refuse(key, place, "the number of a strand and of one of its points, both from 0, such as [0, 17]");
      const std::size_t strand = number_below(knot_.strands.size(), key + ".0", place[0], "strand");
      const std::size_t point = number_below(knot_.strands[strand].points.size(), key + ".1", place[1],
                                             "point of strand " + std::to_string(strand));
      knot_.landmarks.push_back({name, strand, point});
    }
  }

  void read(const YAML::Node& node) {
    for (const auto& [name, what] : named("read", node, "a map such as {eye: {loop: eye}}")) {
      const std::string key = "read." + name;
      if (knot_.readings.size() == PerKnot::kMost)
        reader_.refuse(key, "at most " + std::to_string(PerKnot::kMost) + " things are read of a knot");
      if (!what.IsMap() || what.size() != 1) reader_.refuse(key, what, kWhat);
      const YAML::Node of = what.begin()->second;
      const std::string kind = what.begin()->first.IsScalar() ? what.begin()->first.Scalar() : "";
      if (kind == "loop") {
        const std::size_t around = landmark(key + ".loop", of);
        knot_.readings.push_back({name, KnotReading::Kind::kLoop, around, around});
      } else if (kind == "between" || kind == "distance") {
        const std::string place = key + "." + kind;
        if (!of.IsSequence() || of.size() != 2) reader_.refuse(place, of, "a list of two landmarks");
        const std::size_t first = landmark(place, of[0]), second = landmark(place, of[1]);
        const bool along = kind == "between";
        if (first == second) reader_.refuse(place, "it must have two landmarks that differ");
        if (along && knot_.landmarks[first].strand != knot_.landmarks[second].strand)
          reader_.refuse(place, "both landmarks must be of one strand");
        knot_.readings.push_back(
            {name, along ? KnotReading::Kind::kBetween : KnotReading::Kind::kDistance, first, second});
      } else {
        reader_.refuse(key, what, kWhat);
      }
    }
  }

 private:
  static constexpr const char* kWhat =
      "{loop: LANDMARK}, {between: [LANDMARK, LANDMARK]} or {distance: [LANDMARK, LANDMARK]}";

  /// The items of a map, in their order, whose names differ.
  std::vector<std::pair<std::string, YAML::Node>> named(const char* key, const YAML::Node& node,
                                                        const char* what) const {
    std::vector<std::pair<std::string, YAML::Node>> out;
    if (!node.IsDefined() || node.IsNull()) return out;
    if (!node.IsMap()) reader_.refuse(key, node, what);
    std::set<std::string> known;
    for (const auto& item : node) {
      const std::string name = reader_.name(key, item.first, "a name");
      if (!known.insert(name).second) reader_.refuse(key, shown(name) + " stands there twice");
      out.emplace_back(name, item.second);
    }
    return out;
  }

  std::size_t number_below(std::size_t count, const std::string& key, const YAML::Node& node,
                           const std::string& what) const {
    const std::optional<double> value = node.IsScalar() ? parse_number(node.Scalar()) : std::nullopt;
    if (!value || !(*value >= 0.0 && *value < static_cast<double>(count)) || *value != std::floor(*value))
      reader_.refuse(key, node, "the number of a " + what + ", from 0 to " + std::to_string(count - 1));
    return static_cast<std::size_t>(*value);
  }

  std::size_t landmark(const std::string& key, const YAML::Node& node) const {
    const std::string name = reader_.name(key, node, "the name of a landmark");
    std::vector<std::string> names;
    for (const KnotDrawing::Landmark& one : knot_.landmarks) names.push_back(one.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      reader_.refuse(key, "no landmark is called " + shown(name) + "; " +
                              (names.empty() ? "there are none" : "there are " + listed(names, ", ")));
    return static_cast<std::size_t>(found - names.begin());
  }

  const KnotReader& reader_;
  KnotDrawing& knot_;
};

/// Names differ, and what is held or pulled is an end of a strand. One grip holds it. It is pulled once in a group, and
/// not away from the lower grip, which stands still and bears what all others are pulled with.
void check_names(const KnotReader& reader, const KnotDrawing& knot) {
  std::set<std::string> known;
  for (const std::string& end : ends_of(knot))
    if (!known.insert(end).second) reader.refuse("strands", "two ends are called " + shown(end));
  std::set<std::string> held;
  const auto require_known = [&](const std::string& key, const std::string& end) {
    if (known.count(end) == 0)
      reader.refuse(key, "no end is called " + shown(end) + "; the ends are " + listed(ends_of(knot), ", "));
  };
  const auto hold = [&](const std::string& key, const std::string& end) {
    require_known(key, end);
    if (!held.insert(end).second) reader.refuse(key, shown(end) + " is held already");
  };
  for (const std::string& end : knot.lower) hold("lower", end);
  for (const std::string& end : knot.upper) hold("upper", end);
  for (std::size_t i = 0; i < knot.tie.size(); ++i) {
    const std::string key = "tie." + std::to_string(i);
    std::set<std::string> pulled;
    for (const KnotDrawing::Pull& pull : knot.tie[i]) {
      require_known(key, pull.end);
      if (!pulled.insert(pull.end).second) reader.refuse(key, shown(pull.end) + " is pulled already");
      if (knot.held(pull.end) == KnotDrawing::End::kLower)
        reader.refuse(key, shown(pull.end) +
                               " is held by the lower grip, which stands still and bears what the other "
                               "ends are pulled with; name free ends, and ends of the upper grip");
    }
  }
  for (const KnotDrawing::Landmark& landmark : knot.landmarks)
    if (known.count(landmark.name) != 0) reader.refuse("landmarks", shown(landmark.name) + " is the name of an end");
  for (const KnotDrawing::Landmark& landmark : knot.landmarks) known.insert(landmark.name);
  for (const KnotDrawing::Pull& weight : knot.weights) {
    if (known.count(weight.end) == 0) reader.refuse("weights", "no end and no landmark is called " + shown(weight.end));
    if (knot.held(weight.end) != KnotDrawing::End::kFree)
      reader.refuse("weights", shown(weight.end) + " is held by a grip, which bears what hangs there");
  }
  if (knot.lower.empty() && knot.post_of(false) == nullptr)
    reader.refuse("lower", "the lower grip must hold at least one end, or posts must bear the knot");
  const bool pins = std::any_of(knot.posts.begin(), knot.posts.end(), [](const auto& post) { return post.upper; });
  if (pins == !knot.upper.empty())
    reader.refuse("upper", pins ? "the upper grip must not hold an end where a post with grip: upper stands for it"
                                : "the upper grip must hold at least one end, or be a post with grip: upper");
}

/// The grips pull along z.
void check_held_ends(const KnotReader& reader, const KnotDrawing& knot) {
  for (std::size_t k = 0; k < knot.strands.size(); ++k)
    for (const bool last : {false, true}) {
      const KnotDrawing::Strand& strand = knot.strands[k];
      const std::string& name = strand.ends[last ? 1 : 0];
      const KnotDrawing::End held = knot.held(name);
      if (held == KnotDrawing::End::kFree) continue;
      const std::vector<Vec3>& points = strand.points;
      const Vec3 way = last ? points.back() - points[points.size() - 2] : points.front() - points[1];
      const bool up = held == KnotDrawing::End::kUpper;
      if (way.head<2>().norm() > kOffAxis || (way[2] > 0.0) != up)
        reader.refuse("strands." + std::to_string(k) + ".points",
                      "the end " + shown(name) + " is held by the " + (up ? "upper" : "lower") +
                          " grip, so its last two points must lead straight " + (up ? "up" : "down") + " along z");
    }
}

}  // namespace

std::shared_ptr<const KnotDrawing> read_knot_file(const std::filesystem::path& file, const std::string& name) {
  const YAML::Node root = read_yaml(file);
  const KnotReader reader(file.string());
  Reader top(root, file.string(), "", "a knot");
  KnotDrawing out;
  out.name = name;
  out.title = name;
  top.text("title", out.title);
  top.text("use", out.use);
  top.text("source", out.source);
  for (const auto& [key, words] : {std::pair("title", &out.title), {"use", &out.use}, {"source", &out.source}})
    reader.require_one_line(key, *words);
  const auto names = [&](const std::string& key, const YAML::Node& node) { return reader.name(key, node); };
  const auto strand = [&](const std::string& key, const YAML::Node& node) { return reader.strand(key, node); };
  const auto post = [&](const std::string& key, const YAML::Node& node) { return reader.post(key, node); };
  const auto pulls = [&](const std::string& key, const YAML::Node& node) {
    if (!node.IsMap() || node.size() == 0) reader.refuse(key, node, "a map such as {tail: 1}");
    std::vector<KnotDrawing::Pull> together;
    for (const auto& item : node) {
      const std::string end = reader.name(key, item.first);
      together.push_back({end, reader.number(key + "." + end, item.second, 1e-3, 1e3)});
    }
    return together;
  };
  out.strands = list_of(reader, "strands", top.take("strands"), "a list of strands", strand);
  out.lower = list_of(reader, "lower", top.take("lower"), "a list of names of ends", names);
  out.upper = list_of(reader, "upper", top.take("upper"), "a list of names of ends", names);
  out.posts = list_of(reader, "posts", top.take("posts"), "a list of posts", post);
  out.tie = list_of(reader, "tie", top.take("tie"), "a list of maps such as {tail: 1}", pulls);
  if (const YAML::Node weights = top.take("weights"); weights.IsDefined() && !weights.IsNull())
    out.weights = pulls("weights", weights);
  const YAML::Node landmarks = top.take("landmarks"), read = top.take("read");
  top.finish();
  if (out.strands.empty()) reader.refuse("strands", "a knot must have at least one strand");
  LandmarkReader of_landmarks(reader, out);
  of_landmarks.landmarks(landmarks);
  of_landmarks.read(read);
  check_names(reader, out);
  check_held_ends(reader, out);
  YAML::Node shape = YAML::Clone(root);
  for (const char* words : {"title", "use", "source"}) shape.remove(words);
  out.text = YAML::Dump(shape);
  return std::make_shared<const KnotDrawing>(std::move(out));
}

}  // namespace knot_utm
