#include "knot_utm/numeric/pieces.hpp"

#include <gtest/gtest.h>

namespace knot_utm {
namespace {

TEST(Pieces, LieBetweenTheMissingEdges) {
  const std::vector<Piece> pieces = pieces_between(10, {3, 4, 8});
  ASSERT_EQ(pieces.size(), 4u);
  const Eigen::Index begins[] = {0, 4, 5, 9}, ends[] = {4, 5, 9, 10};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    EXPECT_EQ(pieces[i].begin, begins[i]);
    EXPECT_EQ(pieces[i].end, ends[i]);
  }
  EXPECT_EQ(pieces_between(10, {}).size(), 1u);
  EXPECT_EQ(pieces_between(10, {9, 12}).size(), 1u);
}

TEST(Pieces, AreAsLongAsTheirEdges) {
  Points points = Points::Zero(3, 5);
  points.row(1) << 0.0, 1.0, 3.0, 10.0, 10.5;
  EXPECT_EQ(length_of_pieces(points, {}), 10.5);
  EXPECT_EQ(length_of_pieces(points, {2}), 3.5);
  EXPECT_EQ(length_of_pieces(points, {0, 2}), 2.5);
}

}  // namespace
}  // namespace knot_utm
