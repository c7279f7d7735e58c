#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm::made_up {

/// A made-up test of a fisherman's loop, at the cell's 3 Hz and 3.3 mm/s.
struct Curve {
  double lock = 0.08;      ///< [m]; 0: holds from the start
  double plateau = 6.6;    ///< [N]
  double breakaway = 1.0;  ///< times the plateau, on top of it
  double rise = 0.0;       ///< from the begin of the pull to the lock, of the plateau, which is then the load half way
  double jerk = 0.0;       ///< by which strands that stick and slip let go of it, every 6 mm, of the plateau
  double stiffness = 2e5;  ///< once locked [N/m]
  double ripple = 0.03;    ///< of the plateau
  double noise = 0.01;     ///< of the plateau, standard deviation
  double end = 0.12;       ///< [m]
  double step = 1.1e-3;    ///< of extension between samples [m]
  unsigned seed = 1;

  std::vector<Sample> samples() const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<Sample> result;
    double e = 0.15;
    const auto count = static_cast<int>(end / step);
    for (int i = 0; i <= count; ++i) {
      const double s = i * step;
      Sample sample;
      sample.phase = Phase::kPull;
      sample.extension = s;
      sample.time = 5.0 + s / 3.3e-3;
      const double soft = 2e-3;  // the turn from sliding to stretching is not sharp
      const double share = lock > 0.0 ? 0.5 * std::erfc((s - lock) / soft) : 0.0;
      if (i > 0) e += step * (-2.0 * share + 0.5 * (1.0 - share));
      sample.knot_distance = e + 2e-5 * normal(random);
      const double beyond = std::max(0.0, s - lock);
      const double sliding =
          lock > 0.0 ? plateau * (1.0 + breakaway * std::exp(-s / 3e-3)) * std::min(1.0, s / 1e-3) : 0.0;
      const double wave = 1.0 + 0.5 * ripple * std::sin(2.0 * M_PI * s / 3.2e-3) +
                          (lock > 0.0 ? rise * (std::min(s, lock) / lock - 0.5) : 0.0) +
                          jerk * (std::fmod(s / 6e-3, 1.0) - 0.5);
      sample.load = sliding * wave + plateau * noise * normal(random) + stiffness * beyond;
      sample.force_upper = sample.load;
      sample.force_lower = sample.load * (1.0 + 1e-3);
      sample.normal_force = 3.0 * sample.load + 20.0;
      sample.excess_length = {0.04, 0.04};
      result.push_back(sample);
    }
    return result;
  }
};

/// The results of a loop on rollers, whose load cell reads in every time step.
inline Results on_rollers(const std::vector<Sample>& samples, EndedBy ended_by) {
  return analyse(samples, samples, ended_by, true);
}

}  // namespace knot_utm::made_up
