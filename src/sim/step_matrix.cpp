#include "knot_utm/sim/step_matrix.hpp"

#include <algorithm>

namespace knot_utm {

template <int D>
bool StepMatrix<D>::find(const std::vector<ContactPoint>& contacts) {
  if (pattern_.nodes() != nodes_) return false;
  located_.swap(before_);
  located_.clear();
  // Most contacts stand where they stood at the last look: both lists ascend, so one walk meets them.
  auto row = before_.cbegin();
  for (const ContactPoint& contact : contacts) {
    if (!contact.active()) continue;
    while (row != before_.cend() && row->a0 < contact.a0) ++row;
    auto same = row;
    while (same != before_.cend() && same->a0 == contact.a0 && same->b0 != contact.b0) ++same;
    if (same != before_.cend() && same->a0 == contact.a0) {
      located_.push_back(*same);
      continue;
    }
    located_.push_back({contact.a0, contact.b0, {}});
    if (!look_up(located_.back())) return false;
  }
  return true;
}

template <int D>
bool StepMatrix<D>::look_up(Located& contact) const {
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const std::pair<int, int> stored = pattern_.indices(contact.a0 + k, contact.b0 + l);
      if (stored.first < 0) return false;
      contact.blocks[static_cast<std::size_t>(3 * k + l)] = stored;
    }
  return true;
}

template <int D>
void StepMatrix<D>::build(const std::vector<ContactPoint>& contacts) {
  located_.clear();
  pairs_.clear();
  for (int i = 0; i + 1 < nodes_; ++i) pairs_.push_back({i, i + 1});
  for (int i = 0; i + 2 < nodes_; ++i) pairs_.push_back({i, i + 2});
  for (const ContactPoint& contact : contacts) {
    // A foot slides on to the segment that it is nearer to.
    const bool backwards = contact.c[3] < contact.c[5];
    const int first = std::max(contact.b0 - (backwards ? 1 : 0), 0);
    const int last = std::min(contact.b0 + (backwards ? 2 : 3), nodes_ - 1);
    for (int a = contact.a0; a <= contact.a0 + 2; ++a)
      for (int b = first; b <= last; ++b)
        if (a != b) pairs_.push_back({a, b});
  }
  pattern_.build(nodes_, pairs_);
  matrix_.set_pattern(pattern_);
  stencils_.resize(static_cast<std::size_t>(nodes_));
  for (int i = 0; i < nodes_; ++i)
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        stencils_[static_cast<std::size_t>(i)][static_cast<std::size_t>(3 * k + l)] =
            std::max(k, l) + i < nodes_ ? pattern_.index(i + k, i + l) : -1;
}

template class StepMatrix<3>;
template class StepMatrix<4>;

}  // namespace knot_utm
