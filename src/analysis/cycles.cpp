#include "knot_utm/analysis/cycles.hpp"

#include <algorithm>
#include <cmath>

namespace knot_utm {
namespace {

constexpr double kClosed = 0.1;  // of the cycle's range

double range_of(const Path& path, std::size_t begin, std::size_t end, double PathPoint::*of) {
  double low = path[begin].*of, high = low;
  for (std::size_t i = begin; i <= end; ++i) {
    low = std::min(low, path[i].*of);
    high = std::max(high, path[i].*of);
  }
  return high - low;
}

/// Beginning and end of the path among them.
std::vector<std::size_t> turning_points(const Path& path) {
  std::vector<std::size_t> turns;
  double before = 0.0;  // the last way of the crosshead
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double way = path[i].crosshead - path[i - 1].crosshead;
    if (way == 0.0) continue;  // it may stand where it turns
    if (turns.empty()) turns.push_back(0);
    if (way * before < 0.0) turns.push_back(i - 1);
    before = way > 0.0 ? 1.0 : -1.0;
  }
  if (!turns.empty()) turns.push_back(path.size() - 1);
  return turns;
}

bool comes_back(const Path& path, std::size_t begin, std::size_t end, double PathPoint::*of) {
  return std::abs(path[end].*of - path[begin].*of) <= kClosed * range_of(path, begin, end, of);
}

double enclosed(const Path& path, std::size_t begin, std::size_t end) {
  const auto under = [&](std::size_t from, std::size_t to) {
    return 0.5 * (path[from].force + path[to].force) * (path[to].extension - path[from].extension);
  };
  double area = under(end, begin);
  for (std::size_t i = begin; i < end; ++i) area += under(i, i + 1);
  return area;
}

}  // namespace

std::vector<Cycle> closed_cycles(const Path& path) {
  std::vector<Cycle> cycles;
  const std::vector<std::size_t> turns = turning_points(path);
  for (std::size_t i = 0; i + 2 < turns.size(); ++i) {
    const std::size_t begin = turns[i], end = turns[i + 2];
    if (path[turns[i + 1]].extension < path[begin].extension) continue;  // back and out
    const bool whole = i > 0 && i + 3 < turns.size();
    if (whole || comes_back(path, begin, end, &PathPoint::extension) || comes_back(path, begin, end, &PathPoint::force))
      cycles.push_back({begin, end, enclosed(path, begin, end)});
  }
  return cycles;
}

}  // namespace knot_utm
