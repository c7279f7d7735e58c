#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "knot_utm/analysis/curve_readings.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// How far the mean of F over the part of a plateau that has been read may be from its mean over the whole plateau,
/// with 95 % confidence [N].
///
/// The whole plateau is that of knots that slide up to meeting_extension(). A fraction f of it has been read, and a
/// length r of it is left [m]. The part that was read is divided into n parts of equal extension. Their means m_i
/// scatter by a standard deviation sd(m), and they hold whatever F does over a longer way than a part. Of what was read
/// the mean is M, the least-squares slope is k [N/m], and the last F is F_1. Student's t has n - 1 degrees of freedom:
///
///     d = t sd(m) n^(-1/2) (1 - f)^(1/2) + max(|k| r/2, |F_1 - M| (1 - f))
///
/// The factor with f is that of a sample from a finite population: once the whole plateau has been read, its mean is
/// known. The last term is the change of the mean by a trend that goes on, or by a load that stays as it is now. The
/// result is infinite where nothing of the plateau was pulled, or where a part has fewer than two readings in the mean.
double doubt_about_plateau(const Pull& pull);

/// Follows a test of a loop on rollers and tells when its plateau is settled, so that the rest of the pull would hardly
/// change its mean. That is so once
///
///   - the knots have slid along the plateau by eight radii and by half of it, or along all of it,
///   - doubt_about_plateau is at most 2 % of the mean force that the rod bears, and at most half of the relative error
///     that the plateau force has anyway,
///   - and the test would have a plateau if it ended here (analyse): the knots slide, have not touched each other, and
///     have not begun to lock.
///
/// A plateau that is not settled once it was read to its end never is. Only what the machine answers decides, so the
/// same test gives the same answer to the last bit.
class PlateauWatch {
 public:
  /// `radius` of the rod [m]; `error`: relative error of the plateau force [-], empty where it is not known.
  PlateauWatch(double radius, std::optional<double> error);

  /// Adds an accepted time step.
  void add(const Sample& step) { samples_.push_back(step); }
  /// Adds a reading of the load cell, the last time step once more. Returns whether the plateau is settled by it.
  bool settled_by(const Sample& reading);

 private:
  double least_extension(const Pull& pull) const;
  double next_look_after(const Pull& pull) const;
  bool looks_settled(const Pull& pull) const;

  double radius_;
  double tolerance_;  ///< of the mean force
  std::vector<Sample> samples_, readings_;
  double next_look_ = -std::numeric_limits<double>::infinity();  ///< extension at which to look again [m]
};

}  // namespace knot_utm
