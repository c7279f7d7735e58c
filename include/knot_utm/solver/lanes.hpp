#pragma once

#include <Eigen/Core>
#include <cmath>

namespace knot_utm {

/// Four doubles the compiler keeps in one vector register (or two, without AVX): a vector of three and nothing, or one
/// number of four things that are worked out side by side. Formulas for both, one thing and four, take `double` or
/// `Lanes` for Real, and Eigen's vectors or FourVectors.
using Lanes = double __attribute__((vector_size(32)));
using LanesMask = decltype(Lanes{} < Lanes{});

inline Lanes to_lanes(const Eigen::Vector3d& v) { return Lanes{v[0], v[1], v[2], 0.0}; }
inline Lanes to_lanes(const double* v) { return Lanes{v[0], v[1], v[2], 0.0}; }
inline Eigen::Vector3d to_vec3(const Lanes& v) { return {v[0], v[1], v[2]}; }

/// Of the first three.
inline double dot(const Lanes& a, const Lanes& b) {
  const Lanes products = a * b;
  return products[0] + products[1] + products[2];
}

template <typename Real>
Real constant(double value) {
  return Real{} + value;
}
inline double select(bool where, double a, double b) { return where ? a : b; }
inline Lanes select(const LanesMask& where, const Lanes& a, const Lanes& b) { return where ? a : b; }
inline bool any(bool where) { return where; }
inline bool any(const LanesMask& where) { return ((where[0] | where[1]) | (where[2] | where[3])) != 0; }

inline double square_root(double v) { return std::sqrt(v); }
inline Lanes square_root(const Lanes& v) {
  using Four = Eigen::Array4d;
  Lanes out;
  Eigen::Map<Four, Eigen::Aligned32>(reinterpret_cast<double*>(&out)) =
      Eigen::Map<const Four, Eigen::Aligned32>(reinterpret_cast<const double*>(&v)).sqrt();
  return out;
}
inline double tanh(double v) { return std::tanh(v); }
inline Lanes tanh(const Lanes& v) { return Lanes{std::tanh(v[0]), std::tanh(v[1]), std::tanh(v[2]), std::tanh(v[3])}; }

/// Rows of a 4 x 4 matrix become its columns.
inline void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  const Lanes ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}

/// Four vectors of three, side by side.
struct FourVectors {
  Lanes x, y, z;

  FourVectors() = default;
  FourVectors(const Lanes& x_, const Lanes& y_, const Lanes& z_) : x(x_), y(y_), z(z_) {}
  static FourVectors of(Lanes a, Lanes b, Lanes c, Lanes d) {
    transpose(a, b, c, d);
    return {a, b, c};
  }

  FourVectors& operator+=(const FourVectors& o) { return *this = {x + o.x, y + o.y, z + o.z}; }
  FourVectors& operator-=(const FourVectors& o) { return *this = {x - o.x, y - o.y, z - o.z}; }
};

inline FourVectors operator+(const FourVectors& a, const FourVectors& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline FourVectors operator-(const FourVectors& a, const FourVectors& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline FourVectors operator*(const Lanes& s, const FourVectors& v) { return {s * v.x, s * v.y, s * v.z}; }
inline FourVectors operator*(double s, const FourVectors& v) { return {s * v.x, s * v.y, s * v.z}; }
inline Lanes dot(const FourVectors& a, const FourVectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.dot(b); }

}  // namespace knot_utm
