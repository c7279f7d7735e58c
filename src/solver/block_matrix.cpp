#include "knot_utm/solver/block_matrix.hpp"

#include <suitesparse/amd.h>

#include <algorithm>

namespace knot_utm {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Two lower blocks of a pivot, kept in registers while they meet all of its upper blocks: each entry of those is then
/// read once for both.
template <int D>
class RowPair {
 public:
  RowPair(const Block<D>& a, const Block<D>& b)
      : a0_(a.column[0]),
        a1_(a.column[1]),
        a2_(a.column[2]),
        a3_(a.column[D - 1]),
        b0_(b.column[0]),
        b1_(b.column[1]),
        b2_(b.column[2]),
        b3_(b.column[D - 1]) {}

  /// c_a -= a u, c_b -= b u
  void subtract_products(Block<D>& c_a, Block<D>& c_b, const Block<D>& u) const {
    for (int j = 0; j < D; ++j) {
      const double* entry = reinterpret_cast<const double*>(&u.column[j]);
      Lanes sum_a = c_a.column[j], sum_b = c_b.column[j];
      sum_a -= a0_ * entry[0];
      sum_b -= b0_ * entry[0];
      sum_a -= a1_ * entry[1];
      sum_b -= b1_ * entry[1];
      sum_a -= a2_ * entry[2];
      sum_b -= b2_ * entry[2];
      if constexpr (D == 4) {
        sum_a -= a3_ * entry[3];
        sum_b -= b3_ * entry[3];
      }
      c_a.column[j] = sum_a;
      c_b.column[j] = sum_b;
    }
  }

 private:
  Lanes a0_, a1_, a2_, a3_, b0_, b1_, b2_, b3_;
};

}  // namespace

void BlockPattern::find_neighbours(int nodes, const std::vector<std::pair<int, int>>& pairs) {
  std::vector<std::int64_t>& keys = work_.keys;
  std::vector<int>&begin = work_.begin, &list = work_.list;
  keys.clear();
  for (const auto& [i, j] : pairs) {
    keys.push_back(static_cast<std::int64_t>(i) * nodes + j);
    keys.push_back(static_cast<std::int64_t>(j) * nodes + i);
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  begin.assign(at(nodes) + 1, 0);
  list.clear();
  for (const std::int64_t key : keys) {
    ++begin[static_cast<std::size_t>(key / nodes) + 1];
    list.push_back(static_cast<int>(key % nodes));
  }
  for (int i = 0; i < nodes; ++i) begin[at(i) + 1] += begin[at(i)];
}

void BlockPattern::order_nodes(int nodes) {
  // amd_order would take its workspace from the heap at every call; this is what it makes of a symmetric pattern
  // whose rows are sorted and hold no diagonal, with the room that it leaves for elements.
  Workspace& w = work_;
  const int entries = static_cast<int>(w.list.size()), room = entries + entries / 5 + nodes;
  w.rows.resize(at(room));
  std::copy(w.list.begin(), w.list.end(), w.rows.begin());
  w.row_begin.assign(w.begin.begin(), w.begin.end() - 1);
  w.row_length.resize(at(nodes));
  for (int i = 0; i < nodes; ++i) w.row_length[at(i)] = w.begin[at(i) + 1] - w.begin[at(i)];
  for (std::vector<int>* each : {&w.filled, &w.next, &w.order, &w.head, &w.element, &w.degree, &w.mark})
    each->resize(at(nodes));
  amd_2(nodes, w.row_begin.data(), w.rows.data(), w.row_length.data(), room, entries, w.filled.data(), w.next.data(),
        w.order.data(), w.head.data(), w.element.data(), w.degree.data(), w.mark.data(), nullptr, nullptr);
}

void BlockPattern::build(int nodes, const std::vector<std::pair<int, int>>& pairs) {
  find_neighbours(nodes, pairs);
  order_nodes(nodes);
  const std::vector<int>&begin = work_.begin, &list = work_.list, &order = work_.order;
  position_.assign(at(nodes), 0);
  for (int k = 0; k < nodes; ++k) position_[at(order[at(k)])] = k;

  // Rows below pivot k: its own later neighbours and what its children in the elimination tree pass on.
  row_begin_.assign(at(nodes) + 1, 0);
  rows_.clear();
  std::vector<int>&first_child = work_.first_child, &next_sibling = work_.next_sibling, &seen = work_.seen;
  first_child.assign(at(nodes), -1);
  next_sibling.assign(at(nodes), -1);
  seen.assign(at(nodes), -1);
  for (int k = 0; k < nodes; ++k) {
    const std::size_t first = rows_.size();
    seen[at(k)] = k;
    const int node = order[at(k)];
    for (int a = begin[at(node)]; a < begin[at(node) + 1]; ++a) {
      const int row = position_[at(list[at(a)])];
      if (row > k && seen[at(row)] != k) {
        seen[at(row)] = k;
        rows_.push_back(row);
      }
    }
    for (int child = first_child[at(k)]; child >= 0; child = next_sibling[at(child)]) {
      for (int a = row_begin_[at(child)]; a < row_begin_[at(child) + 1]; ++a) {
        const int row = rows_[at(a)];
        if (row > k && seen[at(row)] != k) {
          seen[at(row)] = k;
          rows_.push_back(row);
        }
      }
    }
    std::sort(rows_.begin() + static_cast<std::ptrdiff_t>(first), rows_.end());
    row_begin_[at(k) + 1] = static_cast<int>(rows_.size());
    if (rows_.size() == first) continue;
    const std::size_t parent = at(rows_[first]);
    next_sibling[at(k)] = first_child[parent];
    first_child[parent] = k;
  }

  diagonal_.assign(at(nodes), 0);
  for (int k = 0; k < nodes; ++k) diagonal_[at(k)] = k + 2 * row_begin_[at(k)];
  blocks_ = nodes + 2 * static_cast<int>(rows_.size());

  lower_begin_.assign(at(nodes) + 1, 0);
  for (const int row : rows_) ++lower_begin_[at(row) + 1];
  for (int k = 0; k < nodes; ++k) lower_begin_[at(k) + 1] += lower_begin_[at(k)];
  lower_.resize(rows_.size());
  std::vector<int>& filled = work_.filled;
  filled.assign(lower_begin_.begin(), lower_begin_.end() - 1);
  for (int k = 0; k < nodes; ++k)
    for (int a = 0; a < below(k); ++a) lower_[at(filled[at(rows(k)[a])]++)] = diagonal(k) + 1 + 2 * a;

  target_begin_.assign(at(nodes), 0);
  targets_.clear();
  for (int k = 0; k < nodes; ++k) {
    target_begin_[at(k)] = targets_.size();
    const int count = below(k);
    for (int a = 0; a < count; ++a) {
      for (int b = 0; b < count; ++b) {
        const int row = rows(k)[a], column = rows(k)[b];
        if (row == column) {
          targets_.push_back(diagonal(row));
        } else {
          const int pivot = std::min(row, column), other = std::max(row, column);
          const int* found = std::lower_bound(rows(pivot), rows(pivot) + below(pivot), other);
          const int stored = diagonal(pivot) + 1 + 2 * static_cast<int>(found - rows(pivot));
          targets_.push_back(row > column ? stored : stored + 1);
        }
      }
    }
  }
}

std::pair<int, int> BlockPattern::indices(int row, int column) const {
  const int r = position(row), c = position(column);
  if (r == c) return {diagonal(r), diagonal(r)};
  const int pivot = std::min(r, c), other = std::max(r, c);
  const int* end = rows(pivot) + below(pivot);
  const int* found = std::lower_bound(rows(pivot), end, other);
  if (found == end || *found != other) return {-1, -1};
  const int lower = diagonal(pivot) + 1 + 2 * static_cast<int>(found - rows(pivot));
  return r > c ? std::make_pair(lower, lower + 1) : std::make_pair(lower + 1, lower);
}

template <int D>
void BlockMatrix<D>::set_pattern(const BlockPattern& pattern) {
  pattern_ = &pattern;
  values_.resize(at(pattern.blocks()));
  work_.resize(at(pattern.nodes()));
  set_zero();
}

template <int D>
void BlockMatrix<D>::set_zero() {
  for (Block<D>& block : values_) block.set_zero();
}

template <int D>
void BlockMatrix<D>::set_identity_row(int node) {
  const int r = pattern_->position(node);
  block(pattern_->diagonal(r)).set_identity();
  // Upper blocks of the row stand with its own pivot, lower ones with the pivots of its earlier neighbours.
  for (int a = 0; a < pattern_->below(r); ++a) block(pattern_->diagonal(r) + 2 + 2 * a).set_zero();
  for (const int* lower = pattern_->lower_begin(r); lower != pattern_->lower_end(r); ++lower) block(*lower).set_zero();
}

template <int D>
void BlockMatrix<D>::set_identity_row(int node, const Lanes& keep) {
  const int r = pattern_->position(node);
  const auto clear = [&](Block<D>& b) {
    for (Lanes& column : b.column) column *= keep;
  };
  Block<D>& own = block(pattern_->diagonal(r));
  clear(own);
  for (int j = 0; j < D; ++j) own.at(j, j) += 1.0 - keep[j];
  for (int a = 0; a < pattern_->below(r); ++a) clear(block(pattern_->diagonal(r) + 2 + 2 * a));
  for (const int* lower = pattern_->lower_begin(r); lower != pattern_->lower_end(r); ++lower) clear(block(*lower));
}

template <int D>
void BlockMatrix<D>::multiply(const Vector& x, Vector& y) const {
  const int nodes = pattern_->nodes();
  std::vector<int> node_at(at(nodes));
  for (int i = 0; i < nodes; ++i) node_at[at(pattern_->position(i))] = i;
  y.assign(at(nodes), Lanes{0.0, 0.0, 0.0, 0.0});
  for (int k = 0; k < nodes; ++k) {
    const int i = node_at[at(k)];
    y[at(i)] += product(block(pattern_->diagonal(k)), x[at(i)]);
    for (int a = 0; a < pattern_->below(k); ++a) {
      const int j = node_at[at(pattern_->rows(k)[a])];
      y[at(j)] += product(block(pattern_->diagonal(k) + 1 + 2 * a), x[at(i)]);
      y[at(i)] += product(block(pattern_->diagonal(k) + 2 + 2 * a), x[at(j)]);
    }
  }
}

template <int D>
bool BlockMatrix<D>::factor() {
  const int nodes = pattern_->nodes();
  for (int k = 0; k < nodes; ++k) {
    Block<D>* own = &values_[at(pattern_->diagonal(k))];
    Block<D> inverse;
    if (!invert(own[0], inverse)) return false;
    own[0] = inverse;
    const int count = pattern_->below(k);
    const int* target = pattern_->targets(k);
    for (int a = 0; a < count; ++a) own[1 + 2 * a] = product(own[1 + 2 * a], inverse);
    int a = 0;
    for (; a + 1 < count; a += 2, target += 2 * count) {
      const RowPair<D> lower(own[1 + 2 * a], own[3 + 2 * a]);
      for (int b = 0; b < count; ++b)
        lower.subtract_products(values_[at(target[b])], values_[at(target[count + b])], own[2 + 2 * b]);
    }
    if (a == count) continue;
    for (int b = 0; b < count; ++b) subtract_product(values_[at(target[b])], own[1 + 2 * a], own[2 + 2 * b]);
  }
  return true;
}

template <int D>
void BlockMatrix<D>::solve(Vector& b) {
  const int nodes = pattern_->nodes();
  for (int i = 0; i < nodes; ++i) work_[at(pattern_->position(i))] = b[at(i)];
  for (int k = 0; k < nodes; ++k) {
    const Block<D>* own = &values_[at(pattern_->diagonal(k))];
    const int* row = pattern_->rows(k);
    const Lanes x = work_[at(k)];
    for (int a = 0; a < pattern_->below(k); ++a) subtract_product(work_[at(row[a])], own[1 + 2 * a], x);
  }
  for (int k = nodes - 1; k >= 0; --k) {
    const Block<D>* own = &values_[at(pattern_->diagonal(k))];
    const int* row = pattern_->rows(k);
    Lanes x = work_[at(k)];
    for (int a = 0; a < pattern_->below(k); ++a) subtract_product(x, own[2 + 2 * a], work_[at(row[a])]);
    work_[at(k)] = product(own[0], x);
  }
  for (int i = 0; i < nodes; ++i) b[at(i)] = work_[at(pattern_->position(i))];
}

template class BlockMatrix<3>;
template class BlockMatrix<4>;

}  // namespace knot_utm
