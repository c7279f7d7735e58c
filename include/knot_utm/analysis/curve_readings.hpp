#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/record/per_knot.hpp"

namespace knot_utm {

/// One reading of a pull. A sample belongs to the pull if its extension is larger than that of every earlier sample, so
/// the extension grows from point to point.
///
/// The alignment to a cache line is part of the results: it decides how the compiler vectorises the sums over a pull,
/// and so in which order they are added. Another alignment would change the last bits of readings.
struct alignas(64) PullPoint {
  double time;                                                      ///< [s]
  double extension;                                                 ///< s [m]
  double knot_distance = std::numeric_limits<double>::quiet_NaN();  ///< e [m]
  double force = 0.0;                                               ///< F, the force on the upper grip [N]
  double normal_force =
      std::numeric_limits<double>::quiet_NaN();  ///< sum of the normal forces of all contacts between strands [N]
  /// The force that the rod bears, without the zero, noise and other errors of the load cell [N]. NaN: not known, and
  /// `force` is used instead.
  double borne = std::numeric_limits<double>::quiet_NaN();
};
using Pull = std::vector<PullPoint>;

/// Excess length of each knot at every point of a pull, that is the length of rod hidden in the knot [m]. Empty where
/// it is not known.
using HiddenRod = std::vector<PerKnot>;

double peak_force(const Pull& pull);  ///< largest F of a pull, which must have a point [N]

/// An interval of extension, from `low` to `high` [m].
struct Range {
  double low, high;
};

/// The plateau of knots that slide from s = `start` to s = `end`: from 0.3 to 0.8 of that way.
Range plateau_between(double start, double end);

/// The interval over which the sliding force is averaged: from 0.3 to 0.8 of the extension between the first point and
/// s = `end`, up to which the knots slide. The breakaway lies before it, and the onset of locking after it. Of a pull
/// that ended within that interval it is the part that was pulled.
Range plateau_range(const Pull& pull, double end);

/// The force over that interval. Integrals are taken by the trapezoidal rule.
struct Plateau {
  double force = 0.0;        ///< mean of F [N]
  double force_sd = 0.0;     ///< standard deviation of F [N]
  double low = 0.0;          ///< smallest F [N]
  double high = 0.0;         ///< largest F [N]
  double force_slope = 0.0;  ///< least-squares slope of F over s [N/m]
  double slope = 0.0;        ///< mean of de/ds [-]; NaN where e is not known
  double rise = 0.0;         ///< growth of F over the interval: twice the difference of the means of its two halves [N]
};

/// Empty where the pull has no point, or where the interval contains no part of it.
std::optional<Plateau> plateau(const Pull& pull, double end);

/// The extension at which knots that slide on rollers have met, which is about where they lock: e_0/2 beyond the first
/// point, where e_0 is the first knot distance [m]. NaN where there are no two knots. The pull must have a point.
double meeting_extension(const Pull& pull);

/// Breakaway force: the largest F before the plateau_range of a pull that slides up to s = `end` [N]. At least 0.
double breakaway_force(const Pull& pull, double end);

/// A fall of F from one point of a pull to a later one that lies within a short extension of it.
struct Drop {
  std::size_t from, to;  ///< indices of the points

  double force(const Pull& pull) const { return pull[from].force - pull[to].force; }  ///< [N]
};

/// de/ds of knots that slide along a loop whose rod does not stretch. On rollers, `on_rollers`, both sides of the loop
/// share what the knots let out; between two held nodes it all stays on the side with the knots.
double rigid_sliding(bool on_rollers);

/// Whether fewer than 20 points lie at extensions up to s = `end`. Neighbouring points are then so far apart that a
/// fall of F between them need not be sudden.
bool has_few_for_drops(const Pull& pull, double end);

/// The largest sudden fall of F before s = `end`: the fall between two points whose extensions differ by at most a
/// twentieth of the extension up to `end`. Two neighbouring points always count. Empty where F only rises, and where
/// has_few_for_drops().
std::optional<Drop> largest_drop(const Pull& pull, double end);

/// A knot that jumped open, as the fall of F that goes with it. Empty where no knot jumped open, and where the pull
/// does not have the readings by which this could be told.
///
/// A knot jumps open if it takes in rod within jump_interval() and F falls; how much of both is asked for, with and
/// without known excess lengths, stands in doc/model.md, section 10, "A jump". Without them the rest of the knots'
/// approach that rigid_sliding() does not explain was 6 to 65 % of e_0 in simulations of knots that jumped open, and at
/// most 4 % for others, whose knots nested into each other. Stretchy strands come nearer by up to 15 % as a knot slips,
/// but F then falls little.
///
/// The result reaches from the largest F of the jump to the smallest F within another jump_interval() after it. No lock
/// is required, because a load that rises to its breakaway and then falls shows a false lock. Only points from the
/// index `begin` on are looked at.
std::optional<Drop> jump(const Pull& pull, bool on_rollers, const HiddenRod& hidden, std::size_t begin = 0);

/// The extension within which a knot jumps open: e_0/40, where e_0 is the first knot distance. That is a twentieth of
/// e_0/2, the extension by which knots that slide on rollers have met [m]. NaN where there are no two knots.
double jump_interval(const Pull& pull);

/// The part of F(s) in which the locked knots carry the load. It consists of the peak and of the points before it, from
/// s = `from` on, back to the first that is below half of the peak. It has at least three points, even if some of them
/// are below that.
struct LockedPart {
  /// Stiffness: the median of the least-squares slopes over three parts of equal extension [N/m]. The median is used
  /// because strands that slip inside a locked knot make F fall in one of the parts.
  double stiffness = 0.0;
  /// Change of the slope from one end of the part to the other, from the first and the third of the three slopes [N/m].
  double change = 0.0;
  double width = 0.0;  ///< extension that it covers [m]
  int points = 0;      ///< number of points in it
};

/// Empty where fewer than three points lie between s = `from` and the peak.
std::optional<LockedPart> locked_part(const Pull& pull, double from);

/// The readings that follow from a force-extension curve alone, measured or simulated. The readings of a test's own
/// load cell stand in result.yaml under the same names, with the same digits.
struct CurveReadings {
  /// s from which F stays above twice the mean of its plateau range, whether or not that range is a plateau [m]
  std::optional<double> rises_at;
  /// s up to which the knots are taken to slide: `rises_at`, or the end of the pull; of a pull that ended within its
  /// plateau meeting_extension() [m]
  double slides_to = 0.0;
  std::optional<Drop> jumped;        ///< the fall of F where a knot jumped open, as indices of points of the pull
  std::optional<double> peak_force;  ///< largest tensile F [N]; empty: F was never above zero
  /// Mean F of the plateau, before the lock or, in a pull without a lock, before its end [N].
  std::optional<double> plateau_force;
  std::optional<double> plateau_force_sd;        ///< standard deviation of F within the plateau [N]
  std::optional<double> plateau_force_low;       ///< smallest F within the plateau [N]
  std::optional<double> plateau_force_high;      ///< largest F within it [N]
  std::optional<double> plateau_force_slope;     ///< dF/ds within it [N/m]
  std::string no_plateau;                        ///< why there is no plateau; empty: there is one
  std::optional<double> largest_drop;            ///< largest sudden fall of F before the lock; 0: F only rose [N]
  std::optional<double> largest_drop_at;         ///< s at which that fall begins [m]
  std::optional<double> jump_force;              ///< F at which a knot jumped open [N]
  std::optional<double> jump_extension;          ///< s at which a knot jumped open [m]
  std::optional<double> force_after_jump;        ///< smallest F just after the jump [N]
  std::optional<double> breakaway_force;         ///< largest F before the plateau [N]
  std::optional<double> lock_extension_by_load;  ///< s_l, lock extension by the load [m]
  std::string no_lock_by_load;                   ///< why there is no s_l; empty: there is one
  std::optional<double> locked_stiffness;  ///< stiffness beyond s_l; of the whole pull where there is no plateau [N/m]
  std::optional<LockedPart> locked;        ///< the part of the curve from which it was read
};

/// What is known of the knots of a pull beside its curve.
struct KnotsOfPull {
  std::string lost;          ///< why there is no sliding force, such as "the knot came undone"; empty: there may be one
  std::string not_sliding;   ///< why a level force is none of sliding; empty: it may be one
  bool untangled = false;    ///< then there is no stiffness either
  bool slid_to_end = false;  ///< then there is no stiffness, unless F rises for good
  bool ended_in_plateau = false;  ///< the test ended as soon as its plateau was settled (PlateauWatch)
};

/// The pull with the force that the rod bears as F, where that is known.
Pull borne_of(Pull pull);

/// Why a pull that ended within its plateau has no reading that the rest of it would tell.
inline constexpr const char* kEndedInPlateau = "the pull ended as soon as its plateau was settled";

/// Reads a curve. `on_rollers`: if it is that of a loop, rollers hold it, not two of its nodes. `hidden` may be empty.
///
/// Whether there is a plateau, a lock or a jump is decided by the force that the rod bears (`PullPoint::borne`), where
/// that is known. The decision is then independent of balancing and of the noise of the load cell. The largest drop is
/// read from the same force. All other values are readings of F.
///
/// The mean of F is a plateau if the knots slide and F is level, as doc/results.md, "When a mean is a plateau", and
/// doc/model.md, section 10, say. A knot that jumped open is another knot from then on, so it has no lock and no
/// stiffness here either.
///
/// The lock extension by the load, s_l, is the extension at which F last rises through twice the mean of its plateau.
/// That plateau range in turn ends at s_l. s_l is therefore a fixed point, and it is the one that an iteration from the
/// peak reaches. A load proportional to s has none. A fixed point is no lock if it lies in the first 15 % of the pull,
/// if there is no plateau, or if it lies between two readings that are further apart than a twentieth of the extension
/// up to it.
CurveReadings curve_readings(const Pull& pull, bool on_rollers, const HiddenRod& hidden = {},
                             const KnotsOfPull& knots = {});

}  // namespace knot_utm
