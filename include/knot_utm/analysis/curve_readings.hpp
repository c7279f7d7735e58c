#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// One reading of a pull. The samples of a pull that count are those that reach a new largest extension. Each fills a
/// cache line, as sums go over all of a pull.
struct alignas(64) PullPoint {
  double time;                           ///< [s]
  double extension;                      ///< s [m]
  double knot_distance = Sample::kNone;  ///< e [m]
  double force = 0.0;                    ///< F on the upper grip [N]
  double normal_force = Sample::kNone;   ///< sum over all contacts of strands [N]
  double borne = Sample::kNone;  ///< by the rod, without the cell's zero and noise [N]; NaN: not known, F counts
};
using Pull = std::vector<PullPoint>;

/// Rod hidden in each knot at every point of a pull [m]; empty where that is not known.
using HiddenRod = std::vector<PerKnot>;

double peak_force(const Pull& pull);  ///< largest F of a pull that has a point [N]

/// From one extension to another [m].
struct Range {
  double low, high;
};

/// Of a pull that slides up to s = `end`, from 0.3 to 0.8 of the way: the breakaway lies before, the onset of locking
/// behind.
Range plateau_range(const Pull& pull, double end);

/// Means over that range, by the trapezoidal rule.
struct Plateau {
  double force = 0.0;        ///< F [N]
  double force_sd = 0.0;     ///< its standard deviation [N]
  double low = 0.0;          ///< smallest F [N]
  double high = 0.0;         ///< largest F [N]
  double force_slope = 0.0;  ///< least-squares slope of F over s [N/m]
  double slope = 0.0;        ///< de/ds [-]; NaN where e is not known
  double rise = 0.0;         ///< of F over the range, by the means of its halves [N]
};

/// None where the range is empty.
std::optional<Plateau> plateau(const Pull& pull, double end);

/// Largest F before the plateau of a pull that slides up to s = `end` [N]; at least 0.
double breakaway_force(const Pull& pull, double end);

/// A fall of F within a twentieth of a way, from one point of a pull to a later one.
struct Drop {
  std::size_t from, to;  ///< points

  double force(const Pull& pull) const { return pull[from].force - pull[to].force; }  ///< [N]
};

/// Whether less than 20 points stand on the way to s = `end`: what lies between two of them need not have come at once.
bool has_few_for_drops(const Pull& pull, double end);

/// The largest fall of F on the way to s = `end`; none where F only rises, and where too few points tell.
std::optional<Drop> largest_drop(const Pull& pull, double end);

/// A knot that jumped open: its coils take in rod at once, within a twentieth of half the first e, which is about the
/// way to the lock, and F does not grow by half, as in a lock. They take in an eighth or more of what the knot held
/// when the pull began. In simulations those that jumped took in 28 to 46 %, and all others at most 8 %.
///
/// Where that is not known, F falls by half or more, and the knots come nearer to each other by more than twice what
/// the grips moved apart, which is all that sliding can do, and more than that by a twentieth of the first e. Those
/// that jumped came nearer by 6 to 65 % of e, and others by at most 4 % as their knots nested into each other; strands
/// that stretch come nearer by up to 15 % as a knot slips, but F then falls little.
///
/// The fall is that from the largest F in there to the smallest from then on, within as long a way. None where no knot
/// jumped, or nothing tells. It does not ask for a lock: a load that rises to its breakaway and then falls has a false
/// one.
std::optional<Drop> jump(const Pull& pull, const HiddenRod& hidden = {});

/// F(s) where the rod carries the load: over the points from s = `from` on, up to the peak, whose F lies between half
/// the peak and the peak, at least the last three.
struct LockedPart {
  /// The middle one of the least-squares slopes in three parts of equal extension: strands that slip inside a locked
  /// knot let F fall at one place [N/m].
  double stiffness = 0.0;
  double change = 0.0;  ///< of the slope from one end to the other, by the outer two of the three [N/m]
  double width = 0.0;   ///< of s [m]
  int points = 0;       ///< from which it was read
};

std::optional<LockedPart> locked_part(const Pull& pull, double from);

/// What a force-extension curve says by itself, be it measured or simulated. A test's own, those of its load cell, are
/// in result.yaml by the same names and to the last digit.
struct CurveReadings {
  std::optional<double> rises_at;    ///< s where F rises for good, be there a plateau or not [m]
  double slides_to = 0.0;            ///< there, else to the end of the pull: s up to which a mean counts [m]
  std::optional<Drop> jumped;        ///< of the points of the pull, where a knot jumped open
  std::optional<double> peak_force;  ///< [N]
  std::optional<double>
      plateau_force;  ///< mean F before the lock, or to the end of a pull without one, where it is a plateau [N]
  std::optional<double> plateau_force_sd;        ///< [N]
  std::optional<double> plateau_force_low;       ///< smallest F within the plateau [N]
  std::optional<double> plateau_force_high;      ///< largest F within it [N]
  std::optional<double> plateau_force_slope;     ///< dF/ds within it [N/m]
  std::string no_plateau;                        ///< why there is no plateau; empty: there is one
  std::optional<double> largest_drop;            ///< largest sudden fall of F before the lock; 0: it only rose [N]
  std::optional<double> largest_drop_at;         ///< s where that began [m]
  std::optional<double> jump_force;              ///< F at which a knot jumped open [N]
  std::optional<double> jump_extension;          ///< s there [m]
  std::optional<double> force_after_jump;        ///< F that was left [N]
  std::optional<double> breakaway_force;         ///< largest F before the plateau, where there is one [N]
  std::optional<double> lock_extension_by_load;  ///< s_l, where there is a plateau [m]
  std::string no_lock_by_load;                   ///< why there is no s_l; empty: there is one
  std::optional<double> locked_stiffness;        ///< behind s_l; of the whole pull where there is no plateau [N/m]
  std::optional<LockedPart> locked;              ///< of which that is the stiffness
};

/// What the curve is, is judged by the force that the rod bears, `PullPoint::borne` where it is known, so that it is
/// the same whether something was balanced or not, and however much noise the load cell has. So is the largest drop.
/// The other readings are of F.
///
/// A mean of F is a plateau where the knots slide and F is level in between:
///   - F was read at least three times within it;
///   - nothing jumped open before the lock: what comes after a jump is another knot, which has no lock and no stiffness
///     of its own here either;
///   - where e is known, de/ds lies within a quarter of the -2 of rigid sliding: half-way to -1, where sliding ends;
///   - F does not fall at once by more than half of its mean: that would be a mean of before and behind;
///   - F changes over the range by less than it would if it grew in proportion to s from the beginning of the pull,
///     10/11 of its mean: such a force has no level of its own. Where neither a lock nor e tells that anything slides,
///     by less than half of its mean.
/// Nylon's force grows while it slides, by 0.7 to 0.9 of its mean: the mean stands, and low, high and slope beside it.
///
/// The lock by the load alone is where F last rises through twice the mean of its plateau, which the lock itself
/// bounds: s_l is the fixed point that is reached from the peak. A load in proportion to s has none, and none counts
/// that lies in the first 15 % of the pull, that has no plateau before it, or that lies between two readings further
/// apart than a twentieth of the way. In simulations of the shipped materials that lock, it lies 1 to 5 % of s_l
/// behind the one that the knots tell (`Results::lock_extension`): F doubles after they have begun to hold.
CurveReadings curve_readings(const Pull& pull, const HiddenRod& hidden = {});

}  // namespace knot_utm
