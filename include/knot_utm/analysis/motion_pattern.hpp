#pragma once

#include <array>
#include <limits>
#include <optional>

#include "knot_utm/analysis/curve_readings.hpp"

namespace knot_utm {

struct Sample;

/// How a fisherman's loop responds to the pull.
enum class MotionPattern {
  kNone,        ///< nothing was pulled yet, or there are no two knots
  kSliding,     ///< the knots slide towards each other under a low, steady load; they may lock later
  kStretching,  ///< the knots hold from the start: e and the load grow
  kUntangling  ///< a knot came undone or jumped open, or opened as the loop was mounted and did not slide and bear more
};

const char* motion_pattern_name(MotionPattern pattern);  ///< "none", "sliding", ... as in result.yaml

/// Follows the motion pattern of a test, sample by sample. Live displays and `analyse` use the same tracker. What makes
/// a pattern stands in doc/model.md, section 10, "Motion pattern".
///
/// Symbols: s extension, e knot distance, F true force on the upper grip, q the limit of de/ds between sliding and
/// stretching. F is used because the reading of the load cell is shifted by its balance. Only samples of the pull
/// count, up to a break. Of these only the ones count that reach a new largest s, because moving back tells nothing.
/// Untangling is decided first, then sliding, and stretching is anything else. A knot that came undone or jumped open
/// is an event: whatever is pulled afterwards is another knot, and how it moves does not change the pattern. Knots that
/// came nearer as the loop was mounted, and then slide and bear more than they did, slide as any others.
///
/// The confidence, 0 to 1, is the mean of those of the following indicators that can be read, each limited to 0 to 1.
/// Lines are least-squares lines whose points are weighted by extension. They are fitted over the part that decides:
/// for sliding from 0.3 to 0.8 of the lock extension, for stretching over the whole pull.
///
///   kinematics  sliding: 1 - |(de/ds)/q - 2|; stretching: 1 - (de/ds)/q
///   load        sliding: 1 - (growth over the part + standard deviation from the line)/mean; stretching: correlation
///               of F with s
///   contact     the same of the sum of the normal forces between strands
///
/// For untangling the confidence is 1 if the knot type shows it, else 0.75.
class MotionPatternTracker {
 public:
  /// `on_rollers`: rollers hold the loop, not two of its nodes. `hung`: weight that hangs on the rod, and that a knot
  /// which came undone still bears [N]. `marks`: e to which mounting sets the knots; 0: they stay where they are [m].
  explicit MotionPatternTracker(bool on_rollers, double hung = 0.0, double marks = 0.0);

  void add(const Sample& sample);

  /// Takes this verdict on jumps in place of its own, which it finds from all time steps: readings of a load cell may
  /// be further apart.
  void set_jumped(bool jumped) { jumped_ = jumped; }

  MotionPattern pattern() const;  ///< pattern of the whole test so far
  double confidence() const;

  /// Lock extension: the extension at which sliding last turned into stretching [m]. Empty where nothing slid, and
  /// until stretching has gone on for a whole window.
  std::optional<double> lock_extension() const;

  /// Time at which the knot came undone [s]: the time at which its type changed. Empty where it did not come undone.
  std::optional<double> untangled_at() const;

  /// By how much the knots are nearer to each other, as the pull begins, than their marks or than they were tied, where
  /// that is so much that a knot opened meanwhile or slid [m].
  std::optional<double> opened_when_mounted() const;

  /// The samples of the pull that count.
  const Pull& pull() const { return pull_; }

 private:
  /// Excess length of a knot [m]. NaN: not known, or there is no such knot.
  struct Excess {
    double tied = std::numeric_limits<double>::quiet_NaN();
    double last = std::numeric_limits<double>::quiet_NaN();  ///< last value of the pull
  };

  void add_tied(const Sample& sample);
  void add_pulled(const Sample& sample);
  void follow_slope(double extension, double before);
  bool slid() const;
  const PullPoint& point_at(double extension) const;
  double mean_between(const PullPoint& first, const PullPoint& last) const;
  void follow_jumps();
  bool vanished() const;
  bool knot_lost() const;
  bool untangles() const;
  bool slides_under_more() const;

  bool on_rollers_;
  double turnover_;  ///< q
  Pull pull_;
  HiddenRod hidden_;              ///< excess lengths at its points
  std::size_t window_begin_ = 0;  ///< first sample of the current window
  std::size_t jump_begin_ = 0;    ///< first sample among which a jump is looked for
  double jump_looked_for_ = -std::numeric_limits<double>::infinity();  ///< extension of the last search [m]
  double window_ = 0.0;                                                ///< width of a window [m]
  double slope_ = 0.0;          ///< de/ds in the current window, NaN before the first is full
  double centre_ = 0.0;         ///< mean extension of the current window [m]
  double slid_ = 0.0;           ///< extension passed while sliding [m]
  double first_sliding_ = 0.0;  ///< extension at which de/ds was first below q [m]
  double last_sliding_ = 0.0;   ///< extension at which de/ds last rose through q, or at which it was last below q [m]
  double hung_ = 0.0;           ///< [N]
  double marks_ = 0.0;          ///< [m]
  double peak_ = 0.0;           ///< largest F [N]
  double mounted_ = 0.0;        ///< largest F before the pull, once the knots were tied and released [N]
  std::array<Excess, PerKnot::kMost> excess_;                        ///< of each knot
  double tied_distance_ = std::numeric_limits<double>::quiet_NaN();  ///< e once the knots are tied and released [m]
  std::optional<double> type_lost_;  ///< time since which the knot type has been another one [s]
  double borne_ = 0.0;               ///< F of the last sample of a pull or a hold [N]
  bool crossed_ = false;             ///< the rod has passed through itself
  bool jumped_ = false;              ///< a knot jumped open
  bool broken_ = false;
};

}  // namespace knot_utm
