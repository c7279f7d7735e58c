// The search for contacts against a look at every pair.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <utility>

#include "contact/candidate_pairs.hpp"
#include "knot_utm/contact/candidates.hpp"
#include "knot_utm/rod/rod.hpp"
#include "properties/random.hpp"

namespace knot_utm::properties {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

/// A rod that wanders at random, edges of different lengths, sometimes crowded, sometimes drawn out.
struct Wandering {
  RodProperties rod;
  Points position;
  double reach, margin, exclusion;

  Wandering() {
    const auto nodes = static_cast<Eigen::Index>(*rc::gen::inRange(3, 80));
    const double drift = random_between(0.0, 2.0);
    const std::vector<int> numbers = random_numbers(static_cast<std::size_t>(3 * nodes));
    const auto number = [&](Eigen::Index i) { return 2e-3 * numbers[static_cast<std::size_t>(i)] - 1.0; };
    position = Points::Zero(3, nodes);
    Eigen::VectorXd rest(nodes - 1);
    for (Eigen::Index i = 1; i < nodes; ++i) {
      Vec3 step = Vec3(number(3 * i), number(3 * i + 1), number(3 * i + 2)) + drift * Vec3::UnitX();
      if (step.norm() < 0.1) step = Vec3::UnitY();
      position.col(i) = position.col(i - 1) + step;
      rest[i - 1] = step.norm();
    }
    rod = make_rod({}, rest);
    reach = random_between(0.1, 3.0);
    margin = random_between(0.1, 1.0);
    exclusion = random_between(0.5, 8.0);
  }

  /// Every pair nearer than `reach` and half of both segments, and so much more; `strict`: by more than rounding may
  /// do.
  Pairs all_pairs(const Points& at, double more, bool strict) const {
    const double tiny = strict ? 1e-9 : -1e-9;
    const Eigen::VectorXd arclength = rod.arclength();
    const auto half = [&](Eigen::Index i) { return 0.5 * std::max(rod.rest_length[i - 1], rod.rest_length[i]); };
    Pairs out;
    for (Eigen::Index i = 1; i + 1 < at.cols(); ++i)
      for (Eigen::Index j = i + 1; j + 1 < at.cols(); ++j)
        if (std::abs(arclength[i] - arclength[j]) >= exclusion + tiny &&
            (at.col(i) - at.col(j)).norm() < reach + more + half(i) + half(j) - tiny)
          out.emplace_back(static_cast<int>(i), static_cast<int>(j));
    return out;
  }

  /// Whether a list has all pairs within reach and margin, and no others. None at all is right, too, where none is
  /// within reach and the rod too taut for that to change.
  void expect_complete(const Pairs& pairs) const {
    if (pairs.empty()) {
      RC_ASSERT(all_pairs(position, 0.0, true).empty());
      return;
    }
    const Pairs least = all_pairs(position, margin, true), most = all_pairs(position, margin, false);
    RC_ASSERT(std::includes(pairs.begin(), pairs.end(), least.begin(), least.end()));
    RC_ASSERT(std::includes(most.begin(), most.end(), pairs.begin(), pairs.end()));
  }
};

RC_GTEST_PROP(CandidatesAgainstEveryPair, StayValidWhileNodesMoveByHalfTheMargin, ()) {
  const Wandering w;
  Candidates candidates(w.rod, w.reach, w.margin, w.exclusion);
  candidates.refresh(w.position);
  Points moved = w.position;
  for (Eigen::Index i = 0; i < moved.cols(); ++i) moved.col(i) += random_place(0.28 * w.margin);  // sqrt(3) of it < 1/2
  RC_ASSERT(!candidates.refresh(moved));
  const Pairs listed = pairs_of(candidates);
  for (const std::pair<int, int>& pair : w.all_pairs(moved, 0.0, true))
    RC_ASSERT(std::binary_search(listed.begin(), listed.end(), pair));
}

RC_GTEST_PROP(CandidatesAgainstEveryPair, AreAllWithinReachAndMarginInAnyFrameAndFromEitherEnd, ()) {
  const Wandering w;
  const Motion motion = random_motion(10.0);
  Candidates here(w.rod, w.reach, w.margin, w.exclusion), there = here;
  const RodProperties backwards = make_rod({}, w.rod.rest_length.reverse());
  Candidates other_end(backwards, w.reach, w.margin, w.exclusion);
  here.refresh(w.position);
  there.refresh(motion.of(w.position));
  other_end.refresh(w.position.rowwise().reverse());
  const int last = static_cast<int>(w.rod.nodes()) - 1;
  Pairs reversed;
  for (const auto& [i, j] : pairs_of(other_end)) reversed.emplace_back(last - j, last - i);
  std::sort(reversed.begin(), reversed.end());
  for (const Pairs& pairs : {pairs_of(here), pairs_of(there), reversed}) w.expect_complete(pairs);
}

}  // namespace
}  // namespace knot_utm::properties
