#pragma once

#include <cmath>

#include "knot_utm/numeric/lanes.hpp"

namespace knot_utm {

/// Dense D x D block, D = 3 or 4, column-major, each column padded to four lanes: a product of two blocks is
/// D^2 vector multiply-adds and no shuffles. Lane 3 of a 3 x 3 block is always zero.
template <int D>
struct Block {
  Lanes column[D];

  void set_zero() {
    for (int j = 0; j < D; ++j) column[j] = Lanes{0.0, 0.0, 0.0, 0.0};
  }
  void set_identity() {
    set_zero();
    for (int j = 0; j < D; ++j) column[j][j] = 1.0;
  }
  double operator()(int row, int col) const { return column[col][row]; }
  double& at(int row, int col) { return reinterpret_cast<double*>(&column[col])[row]; }
};

/// c -= a b
template <int D>
inline void subtract_product(Block<D>& c, const Block<D>& a, const Block<D>& b) {
  for (int j = 0; j < D; ++j) {
    Lanes sum = c.column[j];
    for (int k = 0; k < D; ++k) sum -= a.column[k] * b.column[j][k];
    c.column[j] = sum;
  }
}

/// c = a b
template <int D>
inline Block<D> product(const Block<D>& a, const Block<D>& b) {
  Block<D> c;
  for (int j = 0; j < D; ++j) {
    Lanes sum = a.column[0] * b.column[j][0];
    for (int k = 1; k < D; ++k) sum += a.column[k] * b.column[j][k];
    c.column[j] = sum;
  }
  return c;
}

/// y -= a x
template <int D>
inline void subtract_product(Lanes& y, const Block<D>& a, const Lanes& x) {
  Lanes sum = y;
  for (int k = 0; k < D; ++k) sum -= a.column[k] * x[k];
  y = sum;
}

/// a x
template <int D>
inline Lanes product(const Block<D>& a, const Lanes& x) {
  Lanes sum = a.column[0] * x[0];
  for (int k = 1; k < D; ++k) sum += a.column[k] * x[k];
  return sum;
}

/// Inverse; false where the block is singular or not finite.
inline bool invert(const Block<3>& a, Block<3>& inverse) {
  const double a00 = a(0, 0), a01 = a(0, 1), a02 = a(0, 2);
  const double a10 = a(1, 0), a11 = a(1, 1), a12 = a(1, 2);
  const double a20 = a(2, 0), a21 = a(2, 1), a22 = a(2, 2);
  const double c00 = a11 * a22 - a12 * a21, c10 = a12 * a20 - a10 * a22, c20 = a10 * a21 - a11 * a20;
  const double determinant = a00 * c00 + a01 * c10 + a02 * c20;
  if (determinant == 0.0 || !std::isfinite(determinant)) return false;
  const double r = 1.0 / determinant;
  inverse.column[0] = Lanes{c00 * r, c10 * r, c20 * r, 0.0};
  inverse.column[1] = Lanes{(a02 * a21 - a01 * a22) * r, (a00 * a22 - a02 * a20) * r, (a01 * a20 - a00 * a21) * r, 0.0};
  inverse.column[2] = Lanes{(a01 * a12 - a02 * a11) * r, (a02 * a10 - a00 * a12) * r, (a00 * a11 - a01 * a10) * r, 0.0};
  return true;
}

/// Inverse of the 4 x 4 block [A b; c d] by its Schur complement on d; false where singular or not finite.
inline bool invert(const Block<4>& a, Block<4>& inverse) {
  Block<3> corner;
  for (int j = 0; j < 3; ++j) corner.column[j] = Lanes{a(0, j), a(1, j), a(2, j), 0.0};
  Block<3> ci;
  if (!invert(corner, ci)) return false;
  const Lanes b = {a(0, 3), a(1, 3), a(2, 3), 0.0};
  const Lanes ci_b = product(ci, b);
  Lanes c_ci = {0.0, 0.0, 0.0, 0.0};
  for (int j = 0; j < 3; ++j) c_ci[j] = a(3, 0) * ci(0, j) + a(3, 1) * ci(1, j) + a(3, 2) * ci(2, j);
  const double schur = a(3, 3) - (a(3, 0) * ci_b[0] + a(3, 1) * ci_b[1] + a(3, 2) * ci_b[2]);
  if (schur == 0.0 || !std::isfinite(schur)) return false;
  const double r = 1.0 / schur;
  for (int j = 0; j < 3; ++j) {
    inverse.column[j] = ci.column[j] + ci_b * (c_ci[j] * r);
    inverse.column[j][3] = -c_ci[j] * r;
  }
  inverse.column[3] = -ci_b * r;
  inverse.column[3][3] = r;
  return true;
}

}  // namespace knot_utm
