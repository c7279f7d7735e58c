#include "knot_utm/record/sample_fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "knot_utm/record/per_knot.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

using testing::ElementsAre;

/// Stands for a value of any type.
struct Anything {
  template <typename T>
  operator T() const;
};

template <typename T, typename Places, typename = void>
struct IsMadeOf : std::false_type {};
template <typename T, std::size_t... I>
struct IsMadeOf<T, std::index_sequence<I...>, std::void_t<decltype(T{(static_cast<void>(I), Anything())...})>>
    : std::true_type {};

/// How many values a struct has: as many as it can be made of.
template <typename T, std::size_t N = 0>
constexpr std::size_t values_of() {
  if constexpr (IsMadeOf<T, std::make_index_sequence<N + 1>>::value) {
    return values_of<T, N + 1>();
  } else {
    return N;
  }
}

TEST(SampleFields, HaveARowForEveryMember) {
  EXPECT_EQ(std::tuple_size_v<decltype(kSampleFields)>, values_of<Sample>());
}

/// What was recorded is read again as long as this order stays.
TEST(SampleFields, StandInTheOrderOfTheJournal) {
  std::vector<std::string> names;
  visit_sample_fields([&](const auto& field) { names.emplace_back(field.name); });
  EXPECT_THAT(
      names,
      ElementsAre("sequence", "time", "phase", "displacement", "extension", "end_to_end", "knot_distance", "load",
                  "balance_offset", "force_upper", "force_lower", "tail_force", "excess_length", "tail_length",
                  "max_penetration", "normal_force", "contacts", "fastest_node", "stretching_energy", "bending_energy",
                  "twisting_energy", "contact_energy", "kinetic_energy", "grip_work", "dissipation", "friction_loss",
                  "plastic_loss", "numerical_dissipation", "reweighting_loss", "moment_imbalance", "steps",
                  "rejected_steps", "newton_iterations", "knot_type", "status", "message", "highest_load",
                  "lowest_load", "break_arclength", "break_place", "knots_force", "knot_on_roller", "raw_extension",
                  "turn", "torque", "knot_readings", "half_iterations"));
}

TEST(PerKnot, IsLoadedWithItsLength) {
  PerKnot saved{0.25, PerKnot::kUnknown, 2.0}, loaded{7.0, 7.0, 7.0, 7.0};
  std::string bytes;
  Archive::to(bytes).save(saved);
  Archive archive = Archive::from(bytes, "readings", "a file");
  archive(loaded);
  archive.end();
  ASSERT_EQ(loaded.size(), 3u);
  EXPECT_EQ(loaded[0], 0.25);
  EXPECT_TRUE(std::isnan(loaded[1]));
  EXPECT_EQ(loaded[2], 2.0);
  EXPECT_TRUE(std::isnan(static_cast<const PerKnot&>(loaded)[3]));

  std::string too_many;
  int knots = static_cast<int>(PerKnot::kMost) + 1;
  Archive::to(too_many)(knots);
  Archive refused = Archive::from(too_many, "readings", "a file");
  EXPECT_THROW(refused(loaded), InvalidInput);
}

}  // namespace
}  // namespace knot_utm
