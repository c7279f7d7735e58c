#include "knot_utm/solver/block_matrix.hpp"

#include <suitesparse/amd.h>

#include <algorithm>

#include "knot_utm/numeric/index.hpp"

namespace knot_utm {
namespace {

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

void BlockPattern::order_set(const Neighbours& neighbours, int set) {
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
    for (int a = neighbours.begin[at(node[i])]; a < neighbours.begin[at(node[i]) + 1]; ++a) {
      const int neighbour = neighbours.list[at(a)];
      if (sets_.of(neighbour) == set) w.rows.push_back(w.filled[at(neighbour)]);
    }
    w.row_length.push_back(static_cast<int>(w.rows.size()) - w.row_begin.back());
  }
  const int entries = static_cast<int>(w.rows.size()), room = entries + entries / 5 + nodes;
  w.rows.resize(at(room));
  for (std::vector<int>* each : {&w.size, &w.next, &w.last, &w.head, &w.element, &w.degree, &w.mark})
    each->resize(at(nodes));
  amd_2(nodes, w.row_begin.data(), w.rows.data(), w.row_length.data(), room, entries, w.size.data(), w.next.data(),
        w.last.data(), w.head.data(), w.element.data(), w.degree.data(), w.mark.data(), nullptr, nullptr);
  for (const int i : w.last) node_.push_back(node[i]);
}

void BlockPattern::order_nodes(const Neighbours& neighbours) {
  sets_.build(neighbours);
  work_.filled.resize(at(neighbours.nodes()));
  node_.clear();
  for (int set = 0; set < sets_.count(); ++set) order_set(neighbours, set);
  position_.resize(at(neighbours.nodes()));
  for (int k = 0; k < neighbours.nodes(); ++k) position_[at(node_[at(k)])] = k;
}

void BlockPattern::find_rows(const Neighbours& neighbours) {
  const int nodes = neighbours.nodes(), *list = neighbours.list.data();
  Workspace& w = work_;
  w.row.reset(nodes);
  w.child.assign(at(nodes), -1);
  w.sibling.resize(at(nodes));
  row_begin_.assign(1, 0);
  rows_.clear();
  for (int k = 0; k < nodes; ++k) {
    // Earlier ones become k itself, which is no row of its own: which ones are is as good as random.
    const std::size_t node = at(node_[at(k)]);
    w.row.insert(list + neighbours.begin[node], list + neighbours.begin[node + 1],
                 [&](int neighbour) { return std::max(position_[at(neighbour)], k); });
    w.row.erase(k);
    for (int child = w.child[at(k)]; child >= 0; child = w.sibling[at(child)])
      w.row.insert(rows(child) + 1, rows(child) + below(child), [](int row) { return row; });
    w.row.take(rows_);
    row_begin_.push_back(static_cast<int>(rows_.size()));
    if (below(k) > 0) w.sibling[at(k)] = std::exchange(w.child[at(parent(k))], k);
  }
}

void BlockPattern::find_lower() {
  lower_begin_.assign(at(nodes()) + 1, 0);
  for (const int row : rows_) ++lower_begin_[at(row) + 1];
  for (int row = 0; row < nodes(); ++row) lower_begin_[at(row) + 1] += lower_begin_[at(row)];
  work_.filled.assign(lower_begin_.begin(), lower_begin_.end() - 1);
  lower_.resize(rows_.size());
  for (int k = 0; k < nodes(); ++k)
    for (int a = 0; a < below(k); ++a) lower_[at(work_.filled[at(rows(k)[a])]++)] = diagonal(k) + 1 + 2 * a;
}

void BlockPattern::find_targets() {
  target_begin_.clear();
  std::size_t size = 0;
  for (int k = 0; k < nodes(); ++k) {
    target_begin_.push_back(size);
    size += at(below(k)) * at(below(k));
  }
  targets_.resize(size);
  // Blocks that a pivot updates beyond its parent's row and column the parent updates too: from the last pivot on, they
  // are in its list already.
  for (int k = nodes() - 1; k >= 0; --k) {
    const int count = below(k);
    if (count == 0) continue;
    const int pivot = parent(k), above = below(pivot);
    int* target = targets_.data() + target_begin_[at(k)];
    target[0] = diagonal(pivot);
    // Where rows 1 and on of pivot k stand among the parent's: both lists ascend.
    work_.filled.resize(at(count));
    int* place = work_.filled.data();
    const int* row = rows(pivot);
    for (int b = 1; b < count; ++b) {
      while (*row != rows(k)[b]) ++row;
      place[b] = static_cast<int>(row - rows(pivot));
      target[b] = diagonal(pivot) + 2 + 2 * place[b];
      target[b * count] = diagonal(pivot) + 1 + 2 * place[b];
    }
    for (int a = 1; a < count; ++a) {
      const int* of_parent = targets(pivot) + place[a] * above;
      for (int b = 1; b < count; ++b) target[a * count + b] = of_parent[place[b]];
    }
  }
}

void BlockPattern::build(const Neighbours& neighbours) {
  order_nodes(neighbours);
  find_rows(neighbours);
  diagonal_.resize(at(nodes()));
  for (int k = 0; k < nodes(); ++k) diagonal_[at(k)] = k + 2 * row_begin_[at(k)];
  blocks_ = nodes() + 2 * static_cast<int>(rows_.size());
  find_lower();
  find_targets();
}

std::pair<int, int> BlockPattern::indices(int row, int column) const {
  const int r = position(row), c = position(column);
  const int pivot = std::min(r, c), other = std::max(r, c);
  if (pivot == other) return {diagonal(r), diagonal(r)};
  // Halved without branches: which way a search turns is as good as random.
  const int* found = rows(pivot);
  int left = below(pivot);
  if (left == 0) return {-1, -1};
  while (left > 1) {
    const int half = left / 2;
    found += half * (found[half - 1] < other);
    left -= half;
  }
  if (*found != other) return {-1, -1};
  const int lower = diagonal(pivot) + 1 + 2 * static_cast<int>(found - rows(pivot));
  const int is_upper = r < c;
  return {lower + is_upper, lower + 1 - is_upper};
}

template <int D>
void BlockMatrix<D>::set_pattern(const BlockPattern& pattern) {
  pattern_ = &pattern;
  values_.resize(at(pattern.blocks()));
  work_.resize(at(pattern.nodes()));
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
  y.assign(at(nodes), Lanes{0.0, 0.0, 0.0, 0.0});
  for (int k = 0; k < nodes; ++k) {
    const int i = pattern_->node(k);
    y[at(i)] += product(block(pattern_->diagonal(k)), x[at(i)]);
    for (int a = 0; a < pattern_->below(k); ++a) {
      const int j = pattern_->node(pattern_->rows(k)[a]);
      y[at(j)] += product(block(pattern_->diagonal(k) + 1 + 2 * a), x[at(i)]);
      y[at(i)] += product(block(pattern_->diagonal(k) + 2 + 2 * a), x[at(j)]);
    }
  }
}

template <int D>
void BlockMatrix<D>::take(const Vector& b) {
  for (int i = 0; i < pattern_->nodes(); ++i) work_[at(pattern_->position(i))] = b[at(i)];
}

template <int D>
void BlockMatrix<D>::give(Vector& b) const {
  for (int i = 0; i < pattern_->nodes(); ++i) b[at(i)] = work_[at(pattern_->position(i))];
}

template <int D>
bool BlockMatrix<D>::solve(Vector& b) {
  take(b);
  if (!eliminate()) return false;
  substitute_back();
  give(b);
  return true;
}

template <int D>
bool BlockMatrix<D>::eliminate() {
  bool inverted = false;  // the next pivot is, already
  Block<D> inverse;
  for (int k = 0; k < pattern_->nodes(); ++k) {
    Block<D>* own = &values_[at(pattern_->diagonal(k))];
    if (!inverted && !invert(own[0], inverse)) return false;
    inverted = false;
    own[0] = inverse;
    const Lanes x = work_[at(k)];
    const int count = pattern_->below(k);
    const int *row = pattern_->rows(k), *target = pattern_->targets(k);
    int a = 0;
    Block<D> next;
    for (; a + 1 < count; a += 2, target += 2 * count) {
      const Block<D> lower1 = product(own[1 + 2 * a], inverse), lower2 = product(own[3 + 2 * a], inverse);
      subtract_product(work_[at(row[a])], lower1, x);
      subtract_product(work_[at(row[a + 1])], lower2, x);
      const RowPair<D> lower(lower1, lower2);
      for (int c = 0; c < count; ++c)
        lower.subtract_products(values_[at(target[c])], values_[at(target[count + c])], own[2 + 2 * c]);
      // The next pivot is what it will be once the first row is done with: its inverse, a long chain of operations that
      // wait for each other, is worked out beside the other rows.
      if (a == 0 && row[0] == k + 1) {
        if (!invert(values_[at(target[0])], next)) return false;
        inverted = true;
      }
    }
    if (a < count) {
      const Block<D> lower = product(own[1 + 2 * a], inverse);
      subtract_product(work_[at(row[a])], lower, x);
      for (int c = 0; c < count; ++c) subtract_product(values_[at(target[c])], lower, own[2 + 2 * c]);
    }
    if (inverted) inverse = next;
  }
  return true;
}

template <int D>
void BlockMatrix<D>::substitute_back() {
  for (int k = pattern_->nodes() - 1; k >= 0; --k) {
    const Block<D>* own = &values_[at(pattern_->diagonal(k))];
    const int* row = pattern_->rows(k);
    // A sum for each column: none waits for the others.
    Lanes sum[D] = {};
    for (int a = 0; a < pattern_->below(k); ++a) {
      const Block<D>& upper = own[2 + 2 * a];
      const Lanes& x = work_[at(row[a])];
      for (int j = 0; j < D; ++j) sum[j] += upper.column[j] * x[j];
    }
    Lanes x = work_[at(k)];
    for (const Lanes& part : sum) x -= part;
    work_[at(k)] = product(own[0], x);
  }
}

template class BlockMatrix<3>;
template class BlockMatrix<4>;

}  // namespace knot_utm
