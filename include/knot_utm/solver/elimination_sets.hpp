#pragma once

#include <vector>

#include "knot_utm/solver/neighbours.hpp"

namespace knot_utm {

/// The nodes of a chain in sets that are best eliminated one after the other. Where nothing touches the rod, a node is
/// coupled only to the two nodes before it and the two after it; two or more such nodes in a row are a straight. A
/// straight that is eliminated from one end couples two nodes at a time. One that is eliminated from within, as
/// minimum-degree ordering does between two knots, couples four, at four times the cost. So a knot that only one
/// straight connects to the rest comes first, then that straight up to the next knot, and so on. Knots that are
/// connected in rings are left to minimum-degree ordering, as one last set. Building the sets again reuses the memory.
class EliminationSets {
 public:
  void build(const Neighbours& neighbours);

  int count() const { return static_cast<int>(begin_.size()) - 1; }
  /// Nodes of a set, ascending. Sets come in the order of elimination.
  const int* begin(int set) const { return nodes_.data() + begin_[static_cast<std::size_t>(set)]; }
  const int* end(int set) const { return nodes_.data() + begin_[static_cast<std::size_t>(set) + 1]; }
  /// The set that a node is in.
  int of(int node) const { return set_[static_cast<std::size_t>(node)]; }

 private:
  /// Consecutive nodes: a straight, or what lies between two straights.
  struct Piece {
    int first;
    bool straight;
  };
  /// Pieces that contacts couple with each other, named by the lowest of them.
  struct Knot {
    int straights;  ///< that lead to knots which are not eliminated yet
    int others;     ///< exclusive or of the numbers of those knots: where one is left, its number
    int set;        ///< -1 until it is known
  };

  void find_pieces(const Neighbours& neighbours);
  void join_pieces(const Neighbours& neighbours);
  int find_sets();
  void list_nodes(int sets);

  int knot_of(int piece);
  int set_of_piece(int piece);

  std::vector<Piece> pieces_;
  std::vector<int> piece_of_;  // of every node
  std::vector<int> joined_;    // piece -> a lower one of the same knot, or itself
  std::vector<Knot> knots_;    // by piece
  std::vector<int> set_, begin_, nodes_, filled_;
};

}  // namespace knot_utm
