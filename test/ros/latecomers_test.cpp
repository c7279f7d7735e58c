#include "knot_utm/ros/latecomers.hpp"

#include <gtest/gtest.h>

namespace knot_utm {
namespace {

TEST(Latecomers, LackWhatWasPublishedBefore) {
  Latecomers subscribers;
  subscribers.published(0);
  EXPECT_TRUE(subscribers.came());
  EXPECT_TRUE(subscribers.came());
}

TEST(Latecomers, AreNotThoseWhoGotItBeforeTheirComingIsSaid) {
  Latecomers subscribers;
  subscribers.published(2);
  EXPECT_FALSE(subscribers.came());
  EXPECT_FALSE(subscribers.came());
  EXPECT_TRUE(subscribers.came());
}

/// The first one comes before the message, the second one behind it, and both are said only then.
TEST(Latecomers, AreFoundBehindOneWhoGotIt) {
  Latecomers subscribers;
  subscribers.published(1);
  EXPECT_FALSE(subscribers.came());
  EXPECT_TRUE(subscribers.came());
}

TEST(Latecomers, AreFoundWhereOthersWent) {
  Latecomers subscribers;
  EXPECT_TRUE(subscribers.came());
  EXPECT_TRUE(subscribers.came());
  subscribers.published(1);  // one of them went, which is not said yet
  subscribers.gone();
  EXPECT_TRUE(subscribers.came());
  subscribers.published(2);
  subscribers.gone();
  subscribers.gone();
  EXPECT_TRUE(subscribers.came());
  subscribers.published(2);
  EXPECT_FALSE(subscribers.came());
  EXPECT_TRUE(subscribers.came());
}

}  // namespace
}  // namespace knot_utm
