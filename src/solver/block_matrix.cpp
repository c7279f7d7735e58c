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
  Workspace& w = work_;
  w.row_begin.assign(at(nodes) + 1, 0);
  for (const auto& [i, j] : pairs) {
    ++w.row_begin[at(i) + 1];
    ++w.row_begin[at(j) + 1];
  }
  for (int i = 0; i < nodes; ++i) w.row_begin[at(i) + 1] += w.row_begin[at(i)];
  w.rows.resize(2 * pairs.size());
  w.filled.assign(w.row_begin.begin(), w.row_begin.end() - 1);
  for (const auto& [i, j] : pairs) {
    w.rows[at(w.filled[at(i)]++)] = j;
    w.rows[at(w.filled[at(j)]++)] = i;
  }
  // Transposed, a symmetric pattern is the same again, but now every row is sorted: it was appended to in ascending
  // order, and what it has twice comes twice in a row.
  w.sorted.resize(w.rows.size());
  w.filled.assign(w.row_begin.begin(), w.row_begin.end() - 1);
  for (int i = 0; i < nodes; ++i)
    for (int a = w.row_begin[at(i)]; a < w.row_begin[at(i) + 1]; ++a) {
      const std::size_t j = at(w.rows[at(a)]);
      int& end = w.filled[j];
      if (end == w.row_begin[j] || w.sorted[at(end) - 1] != i) w.sorted[at(end++)] = i;
    }
  w.begin.assign(1, 0);
  w.list.clear();
  for (int i = 0; i < nodes; ++i) {
    w.list.insert(w.list.end(), w.sorted.begin() + w.row_begin[at(i)], w.sorted.begin() + w.filled[at(i)]);
    w.begin.push_back(static_cast<int>(w.list.size()));
  }
}

void BlockPattern::order_set(int set) {
  // amd_order would take its workspace from the heap at every call; this is what it makes of a symmetric pattern
  // whose rows are sorted and hold no diagonal, with the room that it leaves for elements.
  Workspace& w = work_;
  const int* node = sets_.begin(set);
  const int nodes = static_cast<int>(sets_.end(set) - node);
  for (int i = 0; i < nodes; ++i) w.filled[at(node[i])] = i;  // the number of a node within its set
  w.rows.clear();
  w.row_begin.clear();
  w.row_length.clear();
  for (int i = 0; i < nodes; ++i) {
    w.row_begin.push_back(static_cast<int>(w.rows.size()));
    for (int a = w.begin[at(node[i])]; a < w.begin[at(node[i]) + 1]; ++a)
      if (sets_.of(w.list[at(a)]) == set) w.rows.push_back(w.filled[at(w.list[at(a)])]);
    w.row_length.push_back(static_cast<int>(w.rows.size()) - w.row_begin.back());
  }
  const int entries = static_cast<int>(w.rows.size()), room = entries + entries / 5 + nodes;
  w.rows.resize(at(room));
  for (std::vector<int>* each : {&w.size, &w.next, &w.last, &w.head, &w.element, &w.degree, &w.mark})
    each->resize(at(nodes));
  amd_2(nodes, w.row_begin.data(), w.rows.data(), w.row_length.data(), room, entries, w.size.data(), w.next.data(),
        w.last.data(), w.head.data(), w.element.data(), w.degree.data(), w.mark.data(), nullptr, nullptr);
  for (const int i : w.last) w.order.push_back(node[i]);
}

void BlockPattern::order_nodes(int nodes) {
  sets_.build(work_.begin, work_.list);
  work_.filled.resize(at(nodes));
  work_.order.clear();
  for (int set = 0; set < sets_.count(); ++set) order_set(set);
}

template <typename Visit>
void BlockPattern::climb(int row, Visit visit) {
  std::vector<int>&seen = work_.seen, &parent = work_.parent;
  const std::size_t node = at(work_.order[at(row)]);
  seen[at(row)] = row;
  for (int a = work_.begin[node]; a < work_.begin[node + 1]; ++a) {
    const int neighbour = position_[at(work_.list[at(a)])];
    if (neighbour > row) continue;
    for (int k = neighbour; seen[at(k)] != row; k = parent[at(k)]) {
      if (parent[at(k)] < 0) parent[at(k)] = row;
      seen[at(k)] = row;
      visit(k);
    }
  }
}

void BlockPattern::find_rows(int nodes) {
  work_.parent.assign(at(nodes), -1);
  work_.seen.assign(at(nodes), -1);
  row_begin_.assign(at(nodes) + 1, 0);
  for (int row = 0; row < nodes; ++row) climb(row, [&](int k) { ++row_begin_[at(k) + 1]; });
  for (int k = 0; k < nodes; ++k) row_begin_[at(k) + 1] += row_begin_[at(k)];

  // Rows come in ascending order, and so does what each pivot gets of them.
  work_.seen.assign(at(nodes), -1);
  work_.filled.assign(row_begin_.begin(), row_begin_.end() - 1);
  rows_.resize(at(row_begin_.back()));
  lower_begin_.assign(1, 0);
  lower_.clear();
  for (int row = 0; row < nodes; ++row) {
    climb(row, [&](int k) {
      const int place = work_.filled[at(k)]++;
      rows_[at(place)] = row;
      lower_.push_back(k + 1 + 2 * place);
    });
    lower_begin_.push_back(static_cast<int>(lower_.size()));
  }
}

void BlockPattern::find_targets(int nodes) {
  target_begin_.clear();
  std::size_t size = 0;
  for (int k = 0; k < nodes; ++k) {
    target_begin_.push_back(size);
    size += at(below(k)) * at(below(k));
  }
  targets_.resize(size);
  for (int k = 0; k < nodes; ++k) {
    const int count = below(k);
    int* target = targets_.data() + target_begin_[at(k)];
    for (int a = 0; a < count; ++a) {
      const int pivot = rows(k)[a];
      target[a * count + a] = diagonal(pivot);
      // Whatever a pivot touches beyond its first row, that row's pivot touches too: both lists ascend.
      const int* stored = rows(pivot);
      for (int b = a + 1; b < count; ++b) {
        while (*stored != rows(k)[b]) ++stored;
        const int lower = diagonal(pivot) + 1 + 2 * static_cast<int>(stored - rows(pivot));
        target[b * count + a] = lower;
        target[a * count + b] = lower + 1;
      }
    }
  }
}

void BlockPattern::build(int nodes, const std::vector<std::pair<int, int>>& pairs) {
  find_neighbours(nodes, pairs);
  order_nodes(nodes);
  position_.resize(at(nodes));
  for (int k = 0; k < nodes; ++k) position_[at(work_.order[at(k)])] = k;
  find_rows(nodes);
  diagonal_.resize(at(nodes));
  for (int k = 0; k < nodes; ++k) diagonal_[at(k)] = k + 2 * row_begin_[at(k)];
  blocks_ = nodes + 2 * static_cast<int>(rows_.size());
  find_targets(nodes);
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
bool BlockMatrix<D>::solve(Vector& b) {
  const int nodes = pattern_->nodes();
  for (int i = 0; i < nodes; ++i) work_[at(pattern_->position(i))] = b[at(i)];
  if (!eliminate()) return false;
  substitute_back();
  for (int i = 0; i < nodes; ++i) b[at(i)] = work_[at(pattern_->position(i))];
  return true;
}

template <int D>
bool BlockMatrix<D>::eliminate() {
  for (int k = 0; k < pattern_->nodes(); ++k) {
    Block<D>* own = &values_[at(pattern_->diagonal(k))];
    Block<D> inverse;
    if (!invert(own[0], inverse)) return false;
    own[0] = inverse;
    const Lanes x = work_[at(k)];
    const int count = pattern_->below(k);
    const int *row = pattern_->rows(k), *target = pattern_->targets(k);
    int a = 0;
    for (; a + 1 < count; a += 2, target += 2 * count) {
      const Block<D> lower1 = product(own[1 + 2 * a], inverse), lower2 = product(own[3 + 2 * a], inverse);
      subtract_product(work_[at(row[a])], lower1, x);
      subtract_product(work_[at(row[a + 1])], lower2, x);
      const RowPair<D> lower(lower1, lower2);
      for (int c = 0; c < count; ++c)
        lower.subtract_products(values_[at(target[c])], values_[at(target[count + c])], own[2 + 2 * c]);
    }
    if (a == count) continue;
    const Block<D> lower = product(own[1 + 2 * a], inverse);
    subtract_product(work_[at(row[a])], lower, x);
    for (int c = 0; c < count; ++c) subtract_product(values_[at(target[c])], lower, own[2 + 2 * c]);
  }
  return true;
}

template <int D>
void BlockMatrix<D>::substitute_back() {
  for (int k = pattern_->nodes() - 1; k >= 0; --k) {
    const Block<D>* own = &values_[at(pattern_->diagonal(k))];
    const int* row = pattern_->rows(k);
    Lanes x = work_[at(k)];
    for (int a = 0; a < pattern_->below(k); ++a) subtract_product(x, own[2 + 2 * a], work_[at(row[a])]);
    work_[at(k)] = product(own[0], x);
  }
}

template class BlockMatrix<3>;
template class BlockMatrix<4>;

}  // namespace knot_utm
