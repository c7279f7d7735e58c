#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "knot_utm/analysis/curve_readings.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// How far the mean of F over the plateau that has been read may be from its mean over the whole plateau, with 95 %
/// confidence [N].
///
/// The whole plateau is that of knots that slide up to meeting_extension(). The part of it that was pulled is a
/// fraction f of it, and is divided into n parts of equal extension. Their means m_i scatter by a standard deviation
/// sd(m), which has in it whatever F does over a longer extension than a part, a trend too. Student's t has n - 1
/// degrees of freedom:
///
///     d = t sd(m) n^(-1/2) (1 - f)^(1/2)
///
/// The last factor is that of a sample from a finite population: once the whole plateau has been read, its mean is
/// known. Infinite where nothing of the plateau was pulled, or where a part has fewer than two readings in the mean.
double doubt_about_plateau(const Pull& pull);

/// Follows a test of a loop on rollers and tells when its plateau is settled, so that its mean is as well known as it
/// is worth knowing. That is so once
///
///   - the knots have slid along the plateau by a least distance, or along all of it,
///   - doubt_about_plateau is below a fraction of the mean force that the rod bears: half of the relative error that
///   the
///     plateau force has anyway, at most 3 %,
///   - and the test would have a plateau if it ended here (analyse): the knots slide, have not touched each other, and
///     have not begun to lock.
///
/// A plateau that is not settled where it ends will not be settled. Only what the machine answers decides, so the same
/// test gives the same answer to the last bit.
class PlateauWatch {
 public:
  /// `radius` of the rod [m]; `error`: relative error of the plateau force [-], empty where it is not known.
  PlateauWatch(double radius, std::optional<double> error);

  /// Adds an accepted time step.
  void add(const Sample& step);
  /// Adds a reading of the load cell, the last time step once more. Returns whether the plateau is settled by it.
  bool settled_by(const Sample& reading);

 private:
  bool looks_settled(const Pull& pull) const;
  double next_look_after(const Pull& pull) const;

  double radius_;
  double tolerance_;  ///< of the mean force
  std::vector<Sample> samples_, readings_;
  double next_look_ = -std::numeric_limits<double>::infinity();  ///< extension at which to look again [m]
};

}  // namespace knot_utm
