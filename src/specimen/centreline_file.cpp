#include "knot_utm/specimen/centreline_file.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "knot_utm/rod/invalid_input.hpp"

namespace knot_utm {
namespace {

std::optional<double> to_number(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(kBlank) - first + 1);
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const std::from_chars_result end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
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
  constexpr const char* kKey = "specimen.file";
  std::ifstream in(file);
  if (!in) throw InvalidInput(kKey, file, "a CSV file of x,y,z in m that can be read");
  std::vector<Vec3> points;
  std::string line;
  int row = 0;
  int headings = 0;
  while (std::getline(in, line)) {
    ++row;
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const std::optional<Vec3> point = to_point(line);
    if (!point && points.empty() && headings < 2) {
      ++headings;
      continue;
    }
    const std::string place = file + " row " + std::to_string(row);
    if (!point) throw InvalidInput(kKey, place, "three finite numbers x,y,z in m");
    if (!points.empty() && points.back() == *point) {
      throw InvalidInput(kKey, place, "another point than the one before it");
    }
    points.push_back(*point);
  }
  if (points.size() < 4) {
    throw InvalidInput(kKey, file + " with " + std::to_string(points.size()) + " points", "four points or more");
  }
  Points result(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = points[i];
  return result;
}

}  // namespace knot_utm
