#pragma once

#include <optional>
#include <vector>

#include "knot_utm/numeric/block.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Two edges, a from a_0 to a_1 and b from b_0 to b_1 [m].
struct EdgePair {
  Vec3 a0, a1, b0, b1;
};

/// Where two edges meet: fractions of the way along each, 0 to 1.
struct EdgeMeeting {
  double on_a = 0.0, on_b = 0.0;
};

/// Continuous collision detection: whether two edges meet while their four ends go straight, and at constant speed,
/// from `start` to `end`. With the gaps g_kl = a_k - b_l, which are linear in time tau, they do not meet where some
/// direction n(tau) has n.g_kl > 0 for all four: a plane stands between them. With n linear from n_0 to n_1,
///
///     n.g = (1 - tau)^2 n_0.g(0) + tau (1 - tau) (n_0.g(1) + n_1.g(0)) + tau^2 n_1.g(1),
///
/// so the edges stay apart if these three terms are positive. n_0 and n_1 are the directions of the shortest gap at
/// both ends of the time interval. Where the test fails, each half of the interval is tested by itself.
///
/// No passage is missed. Edges that come nearer than a millionth of their extent (gap, lengths and motion together)
/// count as meeting, which bounds the number of halvings. So do edges whose coordinates are not numbers.
std::optional<EdgeMeeting> meeting(const EdgePair& start, const EdgePair& end);

/// Two places of the rod that meet: edges a < b, and the fraction of the way along each, 0 to 1.
struct Tunnelling {
  int edge_a = 0, edge_b = 0;
  double on_a = 0.0, on_b = 0.0;
};

/// Whether a rod passes through itself (tunnelling) while every node moves straight and at constant speed from its
/// start to its end: continuous collision detection between all edges of the polygon of nodes that share no node. It
/// assumes nothing about the rod's shape and motion, the stretch of its edges or the known contacts. No passage is
/// missed.
///
/// Nearly every pair is settled by one of two bounds on pieces of 1, 2, 4, ... edges:
///
/// - Boxes around two pieces, at their start and end and so at all times between, that do not meet.
/// - A piece all of whose edges advance along one direction, e.d > 0, at its start and end. Each edge is linear in
/// time, so it advances at all times between, and the piece cannot come back to itself. This settles edges that are
/// near only because they are neighbours along the rod. d is the middle of a box around the edges as vectors.
///
/// The few pairs of edges that are left are tested one by one (meeting).
class TunnellingSearch {
 public:
  /// `bare_ends`: the contact law begins half an edge from the rod's ends (SmoothContact), so that strands may slip
  /// over these, and half an edge from every cut. Meetings with the outer half of an end edge then do not count.
  explicit TunnellingSearch(Eigen::Index nodes, bool bare_ends = false);

  /// From now on the rod is cut at this edge, too, which anything may pass.
  void part(int edge) { cuts_.push_back(edge); }

  /// Columns are nodes, all of them finite.
  std::optional<Tunnelling> find(const Points& start, const Points& end);

 private:
  struct Box {
    Lanes low, high;
  };
  /// What a piece of the rod passes through in the whole motion.
  struct Piece {
    Box place;    // of its points [m]
    Box advance;  // of its edges, as vectors [m]
  };

  /// Fills the edges' boxes; false where the whole rod advances along one direction.
  bool set_advances(const Points& start, const Points& end);
  void set_places(const Points& start, const Points& end);
  void join_pieces();
  /// Looks for a passage between pieces i <= j of a level, or within one.
  std::optional<Tunnelling> search(std::size_t level, int i, int j) const;
  /// From where to where an edge is tested, as fractions of it: 0, 0.5 or 1.
  struct Tested {
    double from, to;
  };
  bool is_cut(int edge) const;
  Tested tested(int edge) const;
  std::optional<Tunnelling> edges_meet(int a, int b) const;

  static Box join(const Box& a, const Box& b);
  static bool apart(const Box& a, const Box& b);
  static bool advances(const Box& edges);

  std::vector<std::vector<Piece>> pieces_;  // [level][i]: edges i 2^level to (i + 1) 2^level - 1
  const Points* start_ = nullptr;
  const Points* end_ = nullptr;
  bool bare_ends_;
  std::vector<int> cuts_;  // edges
};

}  // namespace knot_utm
