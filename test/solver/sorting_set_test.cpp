#include "knot_utm/solver/sorting_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

namespace knot_utm {
namespace {

TEST(SortingSet, AppendsWhatItWasGivenInAscendingOrder) {
  std::mt19937 random(5);
  SortingSet set;
  for (const int numbers : {1, 63, 64, 65, 300}) {
    set.reset(numbers);
    const auto any = [&] { return static_cast<int>(random() % static_cast<unsigned>(numbers)); };
    for (int round = 0; round < 50; ++round) {
      std::set<int> expected;
      for (int n = 0; n < round % 4; ++n) {
        const std::vector<int> several = {any(), any(), any()};
        set.insert(several.data(), several.data() + several.size(), [&](int i) { return numbers - 1 - i; });
        for (const int i : several) expected.insert(numbers - 1 - i);
        const int a = any(), b = any();
        set.insert_run(std::min(a, b), std::max(a, b));
        for (int i = std::min(a, b); i <= std::max(a, b); ++i) expected.insert(i);
        set.erase(a);
        expected.erase(a);
      }
      std::vector<int> list = {-7};
      set.take(list);
      std::vector<int> whole = {-7};
      whole.insert(whole.end(), expected.begin(), expected.end());
      EXPECT_EQ(list, whole);
    }
  }
}

}  // namespace
}  // namespace knot_utm
