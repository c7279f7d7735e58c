#pragma once

#include <vector>

#include "knot_utm/solver/neighbours.hpp"

namespace knot_utm {

/// Which nodes of a chain are best eliminated before which others. Where nothing touches the rod, a node is coupled to
/// the two before and the two after it only: two or more such nodes in a row are a straight. A straight that is
/// eliminated from one end passes on what two nodes couple, one that is eliminated from within, as the order of least
/// degree has it between two knots, what four do, at four times the cost. So a knot that hangs on the rest by one
/// straight alone comes first, then what follows along that straight up to the next knot, and so on; what hangs
/// together in rings is left to the order of least degree, as one last set. Built again, it keeps its memory.
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
  /// Pieces that contacts hold together, by their lowest one.
  struct Knot {
    int straights;  ///< to other knots, that are not eliminated yet
    int others;     ///< the exclusive or of the knots that those lead to: the only one's number where there is one
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
