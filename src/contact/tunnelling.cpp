#include "knot_utm/contact/tunnelling.hpp"

#include <algorithm>

namespace knot_utm {
namespace {

constexpr double kPlaneRounding = 1e-12;  // more than what rounding does to e.d [fraction of |e||d|]

// Edges further apart along the rod than this many pieces are not neighbours: what lies between would have to advance.
constexpr int kNeighbours = 2;

Lanes load(const Points& points, Eigen::Index i) { return Lanes{points(0, i), points(1, i), points(2, i), 0.0}; }

}  // namespace

TunnellingSearch::TunnellingSearch(Eigen::Index nodes, bool bare_ends) : bare_ends_(bare_ends) {
  pieces_.emplace_back(static_cast<std::size_t>(nodes - 1));
  while (pieces_.back().size() > 1) pieces_.emplace_back((pieces_.back().size() + 1) / 2);
}

std::optional<Tunnelling> TunnellingSearch::find(const Points& start, const Points& end) {
  if (!set_advances(start, end)) return std::nullopt;
  set_places(start, end);
  join_pieces();
  start_ = &start;
  end_ = &end;
  return search(pieces_.size() - 1, 0, 0);
}

TunnellingSearch::Box TunnellingSearch::join(const Box& a, const Box& b) {
  return {smaller(a.low, b.low), larger(a.high, b.high)};
}

bool TunnellingSearch::apart(const Box& a, const Box& b) {
  const auto away = (a.low > b.high) | (b.low > a.high);
  return (away[0] | away[1] | away[2]) != 0;
}

bool TunnellingSearch::advances(const Box& edges) {
  const Lanes d = edges.low + edges.high;
  const Lanes low = d * edges.low, high = d * edges.high;
  const Lanes least = smaller(low, high), size = larger(larger(low, -low), larger(high, -high));
  return least[0] + least[1] + least[2] > kPlaneRounding * (size[0] + size[1] + size[2]);
}

bool TunnellingSearch::set_advances(const Points& start, const Points& end) {
  std::vector<Piece>& edges = pieces_[0];
  Lanes start_before = load(start, 0), end_before = load(end, 0);
  Box all{load(start, 1) - start_before, load(start, 1) - start_before};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto next = static_cast<Eigen::Index>(i) + 1;
    const Lanes start_now = load(start, next), end_now = load(end, next);
    const Lanes first = start_now - start_before, last = end_now - end_before;
    edges[i].advance = {smaller(first, last), larger(first, last)};
    all = join(all, edges[i].advance);
    start_before = start_now;
    end_before = end_now;
  }
  return !advances(all);
}

void TunnellingSearch::set_places(const Points& start, const Points& end) {
  std::vector<Piece>& edges = pieces_[0];
  auto node = [&](Eigen::Index i) -> Box {
    const Lanes first = load(start, i), last = load(end, i);
    return {smaller(first, last), larger(first, last)};
  };
  Box before = node(0);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Box now = node(static_cast<Eigen::Index>(i) + 1);
    edges[i].place = join(before, now);
    before = now;
  }
}

void TunnellingSearch::join_pieces() {
  for (std::size_t level = 1; level < pieces_.size(); ++level) {
    const std::vector<Piece>& small = pieces_[level - 1];
    std::vector<Piece>& large = pieces_[level];
    for (std::size_t i = 0; i < large.size(); ++i) {
      const Piece &first = small[2 * i], &second = small[std::min(2 * i + 1, small.size() - 1)];
      large[i] = {join(first.place, second.place), join(first.advance, second.advance)};
    }
  }
}

std::optional<Tunnelling> TunnellingSearch::search(std::size_t level, int i, int j) const {
  const std::vector<Piece>& pieces = pieces_[level];
  auto piece = [&](int k) -> const Piece& { return pieces[static_cast<std::size_t>(k)]; };
  if (j - i > 1 && apart(piece(i).place, piece(j).place)) return std::nullopt;
  if (j - i <= kNeighbours) {
    Box arc = piece(i).advance;
    for (int k = i + 1; k <= j; ++k) arc = join(arc, piece(k).advance);
    if (advances(arc)) return std::nullopt;
  }
  if (level == 0) return j - i > 1 ? edges_meet(i, j) : std::nullopt;
  const int below = static_cast<int>(pieces_[level - 1].size());
  for (int a = 2 * i; a <= 2 * i + 1; ++a)
    for (int b = i == j ? a : 2 * j; b <= 2 * j + 1 && b < below; ++b)
      if (const std::optional<Tunnelling> found = search(level - 1, a, b)) return found;
  return std::nullopt;
}

bool TunnellingSearch::is_cut(int edge) const { return std::find(cuts_.begin(), cuts_.end(), edge) != cuts_.end(); }

/// A free end edge is tested on its inner half only; its midpoint, too, moves straight.
TunnellingSearch::Tested TunnellingSearch::tested(int edge) const {
  const int last = static_cast<int>(start_->cols()) - 2;
  return {bare_ends_ && (edge == 0 || is_cut(edge - 1)) ? 0.5 : 0.0,
          bare_ends_ && (edge == last || is_cut(edge + 1)) ? 0.5 : 1.0};
}

std::optional<Tunnelling> TunnellingSearch::edges_meet(int a, int b) const {
  if (is_cut(a) || is_cut(b)) return std::nullopt;
  const Tested on_a = tested(a), on_b = tested(b);
  auto place = [](const Points& nodes, int edge, double on) -> Vec3 {
    if (on == 0.0) return nodes.col(edge);
    if (on == 1.0) return nodes.col(edge + 1);
    return 0.5 * (nodes.col(edge) + nodes.col(edge + 1));
  };
  auto pair = [&](const Points& nodes) -> EdgePair {
    return {place(nodes, a, on_a.from), place(nodes, a, on_a.to), place(nodes, b, on_b.from), place(nodes, b, on_b.to)};
  };
  const std::optional<EdgeMeeting> at = meeting(pair(*start_), pair(*end_));
  if (!at) return std::nullopt;
  return Tunnelling{a, b, on_a.from + at->on_a * (on_a.to - on_a.from), on_b.from + at->on_b * (on_b.to - on_b.from)};
}

}  // namespace knot_utm
