#pragma once

#include <Eigen/Core>
#include <cmath>

#include "knot_utm/numeric/lanes_in_two.hpp"
#ifdef __AVX__
#include "knot_utm/numeric/lanes_in_one.hpp"
#endif

namespace knot_utm {

/// Four doubles in one vector register, or in two where registers are shorter. They hold either a vector of three
/// components and an unused lane, or one quantity of four things that are computed side by side. Formulas that serve
/// one thing as well as four take `double` or `Lanes` for Real, and Eigen's vectors or FourVectors.
#ifdef __AVX__
using Lanes = LanesInOne;
using LanesMask = LanesInOneMask;
#else
using Lanes = LanesInTwo;
using LanesMask = LanesInTwoMask;
#endif

inline Lanes to_lanes(const Eigen::Vector3d& v) { return Lanes{v[0], v[1], v[2], 0.0}; }
inline Lanes to_lanes(const double* v) { return Lanes{v[0], v[1], v[2], 0.0}; }
inline Eigen::Vector3d to_vec3(const Lanes& v) { return {v[0], v[1], v[2]}; }

/// The scalar product of the first three lanes.
inline double dot(const Lanes& a, const Lanes& b) {
  const Lanes products = a * b;
  return products[0] + products[1] + products[2];
}

template <typename Real>
Real constant(double value) {
  return Real{} + value;
}
inline double select(bool where, double a, double b) { return where ? a : b; }
inline bool any(bool where) { return where; }

inline Lanes smaller(const Lanes& a, const Lanes& b) { return select(a < b, a, b); }
inline Lanes larger(const Lanes& a, const Lanes& b) { return select(a > b, a, b); }

inline double square_root(double v) { return std::sqrt(v); }
inline Lanes square_root(const Lanes& v) {
  using Four = Eigen::Array4d;
  Lanes out;
  Eigen::Map<Four, Eigen::Aligned32>(reinterpret_cast<double*>(&out)) =
      Eigen::Map<const Four, Eigen::Aligned32>(reinterpret_cast<const double*>(&v)).sqrt();
  return out;
}
inline double larger(double a, double b) { return a > b ? a : b; }
inline double smaller(double a, double b) { return a < b ? a : b; }
inline double exponential(double v) { return std::exp(v); }
inline Lanes exponential(const Lanes& v) {
  return Lanes{std::exp(v[0]), std::exp(v[1]), std::exp(v[2]), std::exp(v[3])};
}
inline double logarithm(double v) { return std::log(v); }
inline Lanes logarithm(const Lanes& v) { return Lanes{std::log(v[0]), std::log(v[1]), std::log(v[2]), std::log(v[3])}; }
inline double power(double v, double exponent) { return std::pow(v, exponent); }
inline Lanes power(const Lanes& v, double exponent) {
  return Lanes{std::pow(v[0], exponent), std::pow(v[1], exponent), std::pow(v[2], exponent), std::pow(v[3], exponent)};
}
inline double tanh(double v) { return std::tanh(v); }
inline Lanes tanh(const Lanes& v) { return Lanes{std::tanh(v[0]), std::tanh(v[1]), std::tanh(v[2]), std::tanh(v[3])}; }

/// Four vectors of three, side by side.
struct FourVectors {
  Lanes x, y, z;

  FourVectors() = default;
  FourVectors(const Lanes& x_, const Lanes& y_, const Lanes& z_) : x(x_), y(y_), z(z_) {}
  static FourVectors of(Lanes a, Lanes b, Lanes c, Lanes d) {
    transpose(a, b, c, d);
    return {a, b, c};
  }
  const Lanes& operator[](int k) const { return k == 0 ? x : k == 1 ? y : z; }

  FourVectors& operator+=(const FourVectors& o) { return *this = {x + o.x, y + o.y, z + o.z}; }
  FourVectors& operator-=(const FourVectors& o) { return *this = {x - o.x, y - o.y, z - o.z}; }
};

inline FourVectors operator+(const FourVectors& a, const FourVectors& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline FourVectors operator-(const FourVectors& a, const FourVectors& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline FourVectors operator*(const Lanes& s, const FourVectors& v) { return {s * v.x, s * v.y, s * v.z}; }
inline FourVectors operator*(double s, const FourVectors& v) { return {s * v.x, s * v.y, s * v.z}; }
inline FourVectors cross(const FourVectors& a, const FourVectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Lanes dot(const FourVectors& a, const FourVectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.dot(b); }
inline FourVectors one_earlier(const FourVectors& now, const FourVectors& after) {
  return {one_earlier(now.x, after.x), one_earlier(now.y, after.y), one_earlier(now.z, after.z)};
}

}  // namespace knot_utm
