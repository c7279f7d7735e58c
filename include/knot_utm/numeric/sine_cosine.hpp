#pragma once

#include <cmath>

#include "knot_utm/numeric/lanes.hpp"

namespace knot_utm {

/// Sines and cosines of four angles [rad], to two units in the last place.
///
/// An angle is k quarter turns and a rest of at most an eighth of a turn. A polynomial gives the sine and the cosine of
/// the rest, and k says which of them has which sign. The quarter turn has three parts, so that the products with k of
/// the first two are exact for angles below kLongestAngle. The library's functions serve longer ones.
/// Source: the polynomials and the parts of the quarter turn are those of fdlibm (Sun Microsystems 1993).
struct SineCosine {
  Lanes sine, cosine;
};

inline SineCosine sine_cosine(const Lanes& angle) {
  constexpr double kLongestAngle = 1e6;  // [rad]
  constexpr double kQuarter[] = {1.57079632673412561417e+00, 6.07710050630396597660e-11, 2.02226624879595063154e-21};
  constexpr double kSine[] = {1.58969099521155010221e-10,  -2.50507602534068634195e-08, 2.75573137070700676789e-06,
                              -1.98412698298579493134e-04, 8.33333333332248946124e-03,  -1.66666666666666324348e-01};
  constexpr double kCosine[] = {-1.13596475577881948265e-11, 2.08757232129817482790e-09,  -2.75573143513906633035e-07,
                                2.48015872894767294178e-05,  -1.38888888888741095749e-03, 4.16666666666666019037e-02};
  // A sum with this number has no digits behind the point.
  constexpr double kRound = 6755399441055744.0;
  const auto whole = [&](const Lanes& number) {
    const Lanes sum = number + kRound;
    return sum - kRound;
  };
  const Lanes quarters = whole((2.0 / M_PI) * angle);
  const Lanes rest = ((angle - quarters * kQuarter[0]) - quarters * kQuarter[1]) - quarters * kQuarter[2];
  const Lanes square = rest * rest;
  Lanes by_sine = {}, by_cosine = {};
  for (const double term : kSine) by_sine = by_sine * square + term;
  for (const double term : kCosine) by_cosine = by_cosine * square + term;
  const Lanes sine = rest + rest * square * by_sine;
  const Lanes cosine = 1.0 - (0.5 * square - square * square * by_cosine);
  const Lanes turn = quarters - 4.0 * whole(0.25 * quarters);  // -2 to 2
  const auto swapped = (turn * turn > 0.5) & (turn * turn < 2.0);
  const Lanes sine_size = select(swapped, cosine, sine), cosine_size = select(swapped, sine, cosine);
  SineCosine out = {select((turn < -0.5) | (turn > 1.5), -sine_size, sine_size),
                    select((turn > 0.5) | (turn < -1.5), -cosine_size, cosine_size)};
  const Lanes size = larger(angle, -angle);
  if (any(size >= kLongestAngle)) {
    for (int k = 0; k < 4; ++k) {
      out.sine[k] = std::sin(angle[k]);
      out.cosine[k] = std::cos(angle[k]);
    }
  }
  return out;
}

}  // namespace knot_utm
