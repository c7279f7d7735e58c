#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/text_rows.hpp"

namespace knot_utm {
namespace {

constexpr const char* kKey = "specimen.file";
constexpr double kFarthest = 1000.0;  // coordinate of a point [m]
constexpr double kLeastStep = 1e-12;  // distance of neighbours below which an edge has no direction [m]

std::optional<double> to_number(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(kBlank) - first + 1);
  if (text.front() == '+' && text.substr(1, 1) != "-") text.remove_prefix(1);
  double value = 0.0;
  const std::from_chars_result end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size()) return std::nullopt;
  // Written so that not-a-number fails.
  if (!(std::abs(value) <= kFarthest)) return std::nullopt;
  return value;
}

std::optional<Vec3> to_point(std::string_view line) {
  Vec3 point;
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != (i == 2)) return std::nullopt;
    const std::optional<double> value = to_number(line.substr(0, comma));
    if (!value) return std::nullopt;
    point[i] = *value;
    if (i < 2) line.remove_prefix(comma + 1);
  }
  return point;
}

}  // namespace

Points read_centreline(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InvalidInput::cannot_read(file, kKey);
  return read_centreline(in, file);
}

Points read_centreline(std::istream& in, const std::string& file) {
  std::vector<Vec3> points;
  TextRows rows(in);
  const auto refuse = [&](const std::string& why) {
    const std::string row = "row " + std::to_string(rows.number());
    throw InvalidInput::sentence(kKey, std::string(kKey) + " " + shown(file) + ": " + row + " " + why);
  };
  int headings = 0;
  while (rows.next()) {
    const std::string& line = rows.text();
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const std::optional<Vec3> point = to_point(line);
    if (!point && points.empty() && headings < 2) {
      ++headings;
      continue;
    }
    if (!point) refuse("is \"" + shown(line) + "\", but must be three numbers x,y,z from -1000 to 1000 m");
    if (!points.empty() && !((points.back() - *point).norm() >= kLeastStep)) {
      refuse("is the same point as the one before it; leave it out");
    }
    points.push_back(*point);
  }
  const std::string whole = std::string(kKey) + " " + shown(file);
  if (!rows.fault().empty()) throw InvalidInput::sentence(kKey, whole + ": " + rows.fault());
  if (points.size() < 4)
    throw InvalidInput::sentence(
        kKey, whole + " has " + std::to_string(points.size()) + " points, but must have four or more");
  Points result(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = points[i];
  return result;
}

namespace {

constexpr double kPulledWay = 0.04;  // extension of a pull, for the paper's radius [m]

/// knot: file. A rod whose centreline is in a CSV file (read_centreline). The grips hold its ends, the upper grip,
/// which moves along +z, the last one. The program does not know whether it is knotted.
class SketchedRod final : public Knot {
 public:
  SketchedRod() {
    about_.name = "file";
    about_.title = "Rod of a shape from a file";
    about_.keys = {"file", "refinement", "natural_curvature"};
    about_.any_shape = true;
  }

  SpecimenOptions defaults(double h) const override {
    SpecimenOptions out;
    out.edge_length = kPaperEdge * (h / kPaperRadius);
    return out;
  }
  double pull(const SpecimenOptions&, double h) const override { return kPulledWay * (h / kPaperRadius); }

  void check(const SpecimenOptions& specimen, double) const override {
    std::error_code error;
    if (specimen.file.empty()) throw InvalidInput::missing("specimen.file", "a CSV file with the columns x,y,z in m");
    if (!std::filesystem::is_regular_file(specimen.file, error))
      throw InvalidInput::cannot_read(specimen.file, "specimen.file");
  }

  Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                        const Mounting& mounting) const override {
    const Points points = read_centreline(specimen.file);
    Centreline out = from_points(points, material.radius, specimen.edge_length, specimen.file, mounting.refinement);
    if (!(out.points.rightCols(1)(2) > out.points.leftCols(1)(2)))
      throw InvalidInput::sentence("specimen.file", "specimen.file " + shown(specimen.file) +
                                                        ": the last point must be higher than the first one, along z");
    return out;
  }
};

}  // namespace

std::unique_ptr<const Knot> sketched_rod() { return std::make_unique<SketchedRod>(); }

}  // namespace knot_utm
