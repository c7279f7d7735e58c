#include "knot_utm/sim/four_nodes.hpp"

#include "knot_utm/numeric/index.hpp"

namespace knot_utm {

namespace {

/// The same block of four nodes' stencils: [row][column].
struct FourBlocks {
  Lanes of[4][4];
};

/// Adds the first columns of blocks (row, column) of the stencils of `count` nodes.
template <int kColumns, bool kTransposed = false>
void add_block(const FourBlocks& blocks, int row, int column, int first, int count, StepMatrix<4>& matrix) {
  Block<4> nowhere;
  Block<4>* to[4] = {&nowhere, &nowhere, &nowhere, &nowhere};
  for (int k = 0; k < count; ++k) to[k] = &matrix.band(first - 1 + k, row, column);
  for (int c = 0; c < kColumns; ++c) {
    Lanes of_node[4];
    for (int r = 0; r < 4; ++r) of_node[r] = kTransposed ? blocks.of[c][r] : blocks.of[r][c];
    transpose(of_node[0], of_node[1], of_node[2], of_node[3]);
    for (int k = 0; k < 4; ++k) to[k]->column[c] += of_node[k];
  }
}

}  // namespace

void subtract_slopes(const FourSlopes& slopes, int first, int count, std::vector<Lanes>& force) {
  const Lanes* e = slopes.of + kOfE;
  const Lanes* f = slopes.of + kOfF;
  Lanes before[4] = {e[0], e[1], e[2], -e[3]}, here[4] = {f[0] - e[0], f[1] - e[1], f[2] - e[2], -f[3]},
        behind[4] = {-f[0], -f[1], -f[2], Lanes{}};
  for (Lanes* node : {before, here, behind}) transpose(node[0], node[1], node[2], node[3]);
  for (int k = 0; k < count; ++k) {
    Lanes* at_node = force.data() + (first - 1 + k);
    at_node[0] += before[k];
    at_node[1] += here[k];
    at_node[2] += behind[k];
  }
}

/// Blocks of the nodes before, at and behind each inner node, with the signs of e and f in their positions.
void add_curves(const FourCurves& k, const FourEdges& edges, int first, int count, StepMatrix<4>& matrix) {
  const Lanes none = {};
  const FourVectors& w = edges.sweep;
  const Lanes sweep[3][3] = {{none, -w[2], w[1]}, {w[2], none, -w[0]}, {-w[1], w[0], none}};
  FourBlocks own_before, before_here, before_behind, own, here_behind, behind_here, own_behind;
  for (int r = 0; r < 4; ++r) {
    const auto signed_row = [&](const Lanes& value) { return r < 3 ? -value : value; };
    for (int c = 0; c < 3; ++c) {
      const Lanes &re = k.at(kOfE + r, kOfE + c), &rf = k.at(kOfE + r, kOfF + c);
      own_before.of[r][c] = -signed_row(re);
      before_here.of[r][c] = signed_row(re - rf);
      before_behind.of[r][c] = signed_row(rf);
    }
    own_before.of[r][3] = signed_row(k.at(kOfE + r, kThetaE));
    before_here.of[r][3] = signed_row(k.at(kOfE + r, kThetaF));
    before_behind.of[r][3] = none;
  }
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      const Lanes ff = k.at(kOfF + r, kOfF + c), ef = k.at(kOfE + r, kOfF + c), fe = k.at(kOfF + r, kOfE + c);
      const Lanes across = ef - ff;
      own.of[r][c] = (k.at(kOfE + r, kOfE + c) - fe) - across + sweep[r][c];
      here_behind.of[r][c] = across - sweep[r][c];
      behind_here.of[r][c] = fe - ff - sweep[r][c];
      own_behind.of[r][c] = ff + sweep[r][c];
    }
    const Lanes &e_theta = k.at(kOfE + r, kThetaF), &f_theta = k.at(kOfF + r, kThetaF);
    const Lanes leans = edges.spin * edges.lean[r];
    own.of[r][3] = e_theta - f_theta;
    own.of[3][r] = e_theta - f_theta + leans;
    here_behind.of[3][r] = f_theta - leans;
    behind_here.of[r][3] = f_theta;
    behind_here.of[3][r] = own_behind.of[3][r] = none;
  }
  own.of[3][3] = k.at(kThetaF, kThetaF) + edges.spin;
  behind_here.of[3][3] = none;
  add_block<4>(own_before, 0, 0, first, count, matrix);
  add_block<4>(before_here, 0, 1, first, count, matrix);
  add_block<3>(before_behind, 0, 2, first, count, matrix);
  add_block<4, true>(before_here, 1, 0, first, count, matrix);
  add_block<4>(own, 1, 1, first, count, matrix);
  add_block<3>(here_behind, 1, 2, first, count, matrix);
  add_block<4, true>(before_behind, 2, 0, first, count, matrix);
  add_block<4>(behind_here, 2, 1, first, count, matrix);
  add_block<3>(own_behind, 2, 2, first, count, matrix);
}

}  // namespace knot_utm
