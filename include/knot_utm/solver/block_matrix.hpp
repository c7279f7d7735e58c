#pragma once

#include <utility>
#include <vector>

#include "knot_utm/numeric/block.hpp"
#include "knot_utm/solver/elimination_sets.hpp"
#include "knot_utm/solver/neighbours.hpp"
#include "knot_utm/solver/sorting_set.hpp"

namespace knot_utm {

/// The fill pattern of an LU factorisation without pivoting, for a matrix of blocks whose structure is symmetric. It
/// holds a fill-reducing order of elimination (AMD within each of the EliminationSets) and, for each pivot, the later
/// rows in which it has blocks. It knows the places of blocks and no values. Building it again reuses its memory.
class BlockPattern {
 public:
  void build(const Neighbours& neighbours);

  int nodes() const { return static_cast<int>(node_.size()); }
  int blocks() const { return blocks_; }  ///< stored: diagonal, lower and upper
  int position(int node) const { return position_[static_cast<std::size_t>(node)]; }  ///< in elimination order
  int node(int position) const { return node_[static_cast<std::size_t>(position)]; }

  /// Where block (row, column) is stored; -1 where the pattern has none.
  int index(int row, int column) const { return indices(row, column).first; }
  /// Where (row, column) and its mirror (column, row) are stored; -1 where the pattern has none.
  std::pair<int, int> indices(int row, int column) const;

  /// For pivot k: in how many later rows it has blocks, which rows these are, and where its diagonal block is stored.
  int below(int k) const {
    return row_begin_[static_cast<std::size_t>(k) + 1] - row_begin_[static_cast<std::size_t>(k)];
  }
  const int* rows(int k) const { return rows_.data() + row_begin_[static_cast<std::size_t>(k)]; }
  int diagonal(int k) const { return diagonal_[static_cast<std::size_t>(k)]; }
  /// Stored index of the lower block of the a-th row below pivot k is diagonal(k) + 1 + 2 a; its mirror follows it.
  /// Stored indices of the lower blocks of row r (those left of its diagonal in elimination order).
  const int* lower_begin(int r) const { return lower_.data() + lower_begin_[static_cast<std::size_t>(r)]; }
  const int* lower_end(int r) const { return lower_.data() + lower_begin_[static_cast<std::size_t>(r) + 1]; }
  const int* targets(int k) const { return targets_.data() + target_begin_[static_cast<std::size_t>(k)]; }

 private:
  /// What a build works with; its contents mean nothing afterwards.
  struct Workspace {
    std::vector<int> child, sibling;  // of every pivot: its last child in the elimination tree, and the child before it
    SortingSet row;
    std::vector<int> filled;
    std::vector<int> rows, row_begin, row_length, size, next, last, head, element, degree, mark;  // as amd_2 takes them
  };

  void order_nodes(const Neighbours& neighbours);
  void order_set(const Neighbours& neighbours, int set);
  /// The rows of a pivot are its later neighbours and the rows of its children in the elimination tree, but for itself
  /// (Liu 1990).
  void find_rows(const Neighbours& neighbours);
  void find_lower();
  void find_targets();
  /// Parent of pivot k in the elimination tree: the first of its rows, where it has any.
  int parent(int k) const { return rows(k)[0]; }

  Workspace work_;
  EliminationSets sets_;
  int blocks_ = 0;
  std::vector<int> node_;         // elimination position -> node
  std::vector<int> position_;     // node -> elimination position
  std::vector<int> row_begin_;    // pivot -> first of rows_
  std::vector<int> rows_;         // positions later than the pivot, ascending
  std::vector<int> diagonal_;     // pivot -> stored index of its diagonal block
  std::vector<int> lower_begin_;  // row -> first of lower_
  std::vector<int> lower_;
  std::vector<std::size_t> target_begin_;
  std::vector<int> targets_;  // pivot, row a, column b -> stored index of the block that L_a U_b updates
};

/// Square matrix of D x D blocks on a fixed pattern, solved in place by A = L U, L having unit blocks on its diagonal.
/// The values may be unsymmetric. There is no pivoting, because the matrix is the Jacobian of an implicit step, whose
/// diagonal dominates where the step is short enough. A singular pivot block is reported.
template <int D>
class BlockMatrix {
 public:
  using Vector = std::vector<Lanes>;  ///< one entry a node, in the caller's order; lanes beyond D are zero

  /// Sets the pattern; the values are then undefined. Memory is reused from pattern to pattern.
  void set_pattern(const BlockPattern& pattern);

  Block<D>& block(int stored_index) { return values_[static_cast<std::size_t>(stored_index)]; }
  const Block<D>& block(int stored_index) const { return values_[static_cast<std::size_t>(stored_index)]; }
  const BlockPattern& pattern() const { return *pattern_; }

  /// Row `node` becomes that of the identity: its unknown is prescribed by the right-hand side.
  void set_identity_row(int node);
  /// The same for those rows of the block whose lane of `keep` is 0. Rows whose lane is 1 stay.
  void set_identity_row(int node, const Lanes& keep);

  /// y = A x, before solving.
  void multiply(const Vector& x, Vector& y) const;

  /// Solves A x = b; b becomes x. False where a pivot block is singular. U and the inverse pivots overwrite the matrix.
  /// L is applied to b as it is computed and is not kept.
  bool solve(Vector& b);

 private:
  bool eliminate();
  void substitute_back();
  void take(const Vector& b);
  void give(Vector& b) const;

  const BlockPattern* pattern_ = nullptr;
  std::vector<Block<D>> values_;
  Vector work_;
};

extern template class BlockMatrix<3>;
extern template class BlockMatrix<4>;

}  // namespace knot_utm
