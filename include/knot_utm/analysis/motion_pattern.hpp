#pragma once

#include <array>
#include <optional>

#include "knot_utm/analysis/curve_readings.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// How a fisherman's loop answers the pull.
enum class MotionPattern {
  kNone,        ///< no pull yet, or no two knots
  kSliding,     ///< the knots slide towards each other under a low, steady load; they may lock later
  kStretching,  ///< the knots hold from the start: e and the load grow
  kUntangling   ///< a knot came undone, or opened after breakaway and carries no load any more
};

const char* motion_pattern_name(MotionPattern pattern);  ///< "none", "sliding", ... as in result.yaml

/// Follows the motion pattern of a test, sample by sample; live displays and `analyse` use the same one.
///
/// Symbols: s extension, e knot distance, F true force on the upper grip (what the load cell reads is shifted by its
/// balance). Only samples of the pull count, and of these only those that reach a
/// new largest s (pulling back says nothing), up to a break.
///
/// Kinematics: knots that slide rigidly along the two strands give de/ds = -2 exactly; strands that only stretch give
/// de/ds = e/L > 0. de/ds is the least-squares slope over a window of s, 3 % of the first e wide; half-way, at -1, the
/// one turns into the other. The specimen **slides** as long as de/ds < -1, and has **locked** where it last was.
///
///   sliding     at least one window, and 15 % of all extension, was passed at de/ds < -1; and up to where it last was
///               the knots came nearer to each other by more than s grew: either from the beginning of the pull, or,
///               where they held first, from where they began to slide, under a load that there was less than twice its
///               mean. Else something beside them gave way
///   untangling  the knot type is another one, and nothing is borne: F is below 5 % of its largest value, or nothing
///               has been pulled, or the excess length in a knot, where known, is below a quarter of that of the tied
///               knot; or F fell for a window below 5 %, has not come back, and the excess length in a knot, where
///               known, grew beyond 1.5 times that of the tied knot; or the rod ran through itself
///   stretching  anything else
///
/// A knot type alone says nothing while the load is borne: it is told by a closure of the open ends, which a knot on a
/// roller can put in another place.
///
/// Confidence, 0 to 1, is the mean of independent signs, each 0 to 1, where they can be read. Deviations are those
/// from a line, means weighted by extension, both over the part that decides (sliding: 0.3 to 0.8 of the lock
/// extension; stretching: all of it):
///   kinematics  sliding: 1 - |de/ds + 2|; stretching: 1 + de/ds
///   load        sliding: 1 - (rise over the part + standard deviation) / mean; stretching: correlation with s
///   contact     the same of the sum of normal forces between strands
/// Untangling: 1 where the knot type says so, 0.75 where load and excess length show it, 0.5 where the load alone does.
class MotionPatternTracker {
 public:
  void add(const Sample& sample);

  MotionPattern pattern() const;  ///< of the whole test so far
  MotionPattern current() const;  ///< of the last window alone: sliding or stretching; live displays
  double confidence() const;

  /// Extension at which sliding turned into stretching, for good as far as seen [m]; none before it has gone on for a
  /// window, and where nothing slid.
  std::optional<double> lock_extension() const;

  /// Time at which the knot came undone [s]: since when the knot type is another one, or else since when the load is
  /// gone.
  std::optional<double> untangled_at() const;

  /// The samples of the pull that count.
  const Pull& pull() const { return pull_; }

 private:
  /// Rod length hidden in a knot [m]; NaN: not known, or there is no such knot.
  struct Excess {
    double tied = Sample::kNone;
    double last = Sample::kNone;     ///< of the pull
    double largest = Sample::kNone;  ///< of the pull
  };

  void add_tied(const Sample& sample);
  void add_pulled(const Sample& sample);
  void follow_slope(double extension, double before);
  bool slid() const;
  const PullPoint& point_at(double extension) const;
  double mean_between(const PullPoint& first, const PullPoint& last) const;
  bool opened() const;
  bool vanished() const;
  bool knot_lost() const;
  bool load_gone() const;

  Pull pull_;
  std::size_t window_begin_ = 0;               ///< first sample of the current window
  double window_ = 0.0;                        ///< its width [m]
  double slope_ = 0.0;                         ///< de/ds in the current window, NaN before the first is full
  double centre_ = 0.0;                        ///< mean extension of the current window [m]
  double slid_ = 0.0;                          ///< extension passed while sliding [m]
  double first_sliding_ = 0.0;                 ///< where de/ds was first below -1 [m]
  double last_sliding_ = 0.0;                  ///< where de/ds last rose through -1 or was still below [m]
  double peak_ = 0.0;                          ///< largest F [N]
  std::array<Excess, PerKnot::kMost> excess_;  ///< of each knot
  std::optional<double> gone_since_;           ///< time since which F is gone [s]
  double gone_extension_ = 0.0;                ///< extension there [m]
  std::optional<double> type_lost_;            ///< since when the knot type is another one [s]
  double borne_ = 0.0;                         ///< F, as last pulled or held [N]
  bool crossed_ = false;                       ///< the rod ran through itself
  bool broken_ = false;
};

}  // namespace knot_utm
