#include "knot_utm/contact/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace knot_utm {

namespace {

/// Cells of a uniform grid as one number each; 21 bits a direction. Neighbours along k have neighbouring numbers, and
/// numbers add up as cells do.
std::int64_t cell_key(std::int64_t i, std::int64_t j, std::int64_t k) {
  constexpr std::int64_t kRow = std::int64_t{1} << 21;
  return (i * kRow + j) * kRow + k;
}

}  // namespace

Candidates::Candidates(const RodProperties& rod, double reach, double margin, double exclusion, double extent)
    : reach_(reach),
      margin_(margin),
      exclusion_(exclusion),
      extent_(extent),
      arclength_(rod.arclength()),
      size_(Eigen::VectorXd::Zero(rod.nodes())) {
  const Eigen::Index nodes = rod.nodes();
  // None of these can hold more: a build takes no memory for them.
  entries_.reserve(static_cast<std::size_t>(nodes));
  found_.reserve(static_cast<std::size_t>(nodes));
  segments_.reserve(static_cast<std::size_t>(nodes));
}

bool Candidates::refresh(const Points& position) {
  if (built_at_.cols() == position.cols()) {
    const double moved = (position - built_at_).colwise().squaredNorm().maxCoeff();
    if (moved < 0.25 * margin_ * margin_) return false;
  }
  build(position);
  return true;
}

void Candidates::part(int edge) {
  parted_ = edge;
  built_at_.resize(3, 0);
}

void Candidates::measure(const Points& position) {
  double before = (position.col(1) - position.col(0)).norm();
  for (Eigen::Index i = 1; i + 1 < position.cols(); ++i) {
    const double after = (position.col(i + 1) - position.col(i)).norm();
    size_[i] = reaches_into_parted(static_cast<int>(i)) ? 0.0 : extent_ * std::max(before, after);
    before = after;
  }
}

bool Candidates::is_taut(const Points& position) const {
  // Two places lie no nearer to each other than the rod between them is long, less all of its slack: what its length
  // exceeds the distance of its ends by.
  double length = 0.0, least_stretch = 1.0;
  for (Eigen::Index i = 0; i + 1 < position.cols(); ++i) {
    const double edge = (position.col(i + 1) - position.col(i)).norm();
    length += edge;
    least_stretch = std::min(least_stretch, edge / (arclength_[i + 1] - arclength_[i]));
  }
  const double slack = length - (position.rightCols(1) - position.leftCols(1)).norm();
  return least_stretch * exclusion_ - slack >= reach_ + margin_ + 2.0 * size_.maxCoeff();
}

void Candidates::state(Archive& archive) {
  bool built = built_at_.cols() > 0;
  archive(built);
  if (archive.loads()) built_at_.resize(3, built ? arclength_.size() : 0);
  archive(built_at_);
  archive.require(are_places(built_at_), "places of the nodes", "that of no rod");
  if (archive.loads() && built) build(built_at_);
}

Candidates::Rows Candidates::rows_around(std::int64_t own) const {
  const auto at = [&](std::int64_t key) {
    const auto found = std::lower_bound(entries_.begin(), entries_.end(), key,
                                        [](const Entry& e, std::int64_t wanted) { return e.key < wanted; });
    return entries_.data() + (found - entries_.begin());
  };
  Rows rows;
  auto row = rows.begin();
  for (int di = -1; di <= 1; ++di)
    for (int dj = -1; dj <= 1; ++dj) {
      // The three cells along the last direction have consecutive keys.
      const std::int64_t low = own + cell_key(di, dj, -1);
      *row++ = {at(low), at(low + 3)};
    }
  return rows;
}

void Candidates::build(const Points& position) {
  built_at_ = position;
  pairs_.clear();
  segments_.clear();
  runs_.clear();
  begin_.assign(static_cast<std::size_t>(position.cols()) + 1, 0);
  measure(position);
  if (parted_ == kWhole && is_taut(position)) return;
  const int nodes = static_cast<int>(position.cols());
  const double cell = reach_ + margin_ + 2.0 * size_.maxCoeff();
  const Vec3 origin = position.rowwise().minCoeff().array() - cell;

  entries_.clear();
  auto key_of = [&](int i) {
    const Vec3 q = (position.col(i) - origin) / cell;
    return cell_key(static_cast<std::int64_t>(q[0]), static_cast<std::int64_t>(q[1]), static_cast<std::int64_t>(q[2]));
  };
  for (int i = 1; i + 1 < nodes; ++i)
    if (!reaches_into_parted(i)) entries_.push_back({key_of(i), i});
  std::sort(entries_.begin(), entries_.end(),
            [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.segment < b.segment; });

  std::int64_t around = -1;
  Rows rows = {};
  for (int i = 1; i + 1 < nodes; ++i) {
    begin_[static_cast<std::size_t>(i)] = runs_.size();
    found_.clear();
    if (reaches_into_parted(i)) continue;
    // The next segment along the rod stands in the same cell as a rule.
    if (const std::int64_t own = key_of(i); own != around) rows = rows_around(around = own);
    for (const auto& [first, last] : rows) {
      for (const Entry* entry = first; entry != last; ++entry) {
        const int j = entry->segment;
        if (std::abs(arclength_[i] - arclength_[j]) < exclusion_) continue;
        const double limit = reach_ + margin_ + size_[i] + size_[j];
        if ((position.col(i) - position.col(j)).squaredNorm() < limit * limit) found_.push_back(j);
      }
    }
    if (found_.empty()) continue;
    std::sort(found_.begin(), found_.end());
    segments_.push_back(i);
    for (const int j : found_) {
      if (i < j) pairs_.push_back({i, j});
      if (runs_.size() > begin_[static_cast<std::size_t>(i)] && runs_.back().last + 1 == j)
        runs_.back().last = j;
      else
        runs_.push_back({j, j});
    }
  }
  for (int i = std::max(nodes - 1, 0); i <= nodes; ++i) begin_[static_cast<std::size_t>(i)] = runs_.size();
}

}  // namespace knot_utm
