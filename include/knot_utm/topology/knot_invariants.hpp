#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/topology/crossings.hpp"

namespace knot_utm {

/// Coefficients of an Alexander polynomial from the lowest power up, normalised: the first is that of t^0 and not
/// zero, and Delta(1) = 1. The unknot's is {1}.
using KnotPolynomial = std::vector<std::int64_t>;

/// Alexander polynomial of a closed polygon (the last point joins the first; it is not repeated).
///
/// Exact: of several generic projections the one with the fewest crossings gives Wirtinger relations
///   a_out = (1 - t) a_over + t a_in,  or with a_out and a_in exchanged where the crossing is negative;
/// the determinant of a first minor is evaluated modulo the prime 2^61 - 1 at as many t as it has coefficients, and
/// interpolated. Right as long as the coefficients are below 2^60. Throws std::runtime_error where no projection is
/// that of a knot, because the polygon runs through itself.
KnotPolynomial alexander_polynomial(const Points& polygon);

/// |Delta(-1)|.
std::int64_t knot_determinant(const KnotPolynomial& polynomial);

/// Linking number of two disjoint closed polygons: half the sum of the signs of their crossings.
int linking_number(const Points& first, const Points& second);

/// An open rod closed through infinity: both ends go straight on along `axis` (the first end against it), and are
/// joined far away. For overhands between clamps, `axis` runs from the first end to the last.
Points closed_far_away(const Points& open, const Vec3& axis);

/// The topology of a fisherman's loop, with a closure that swinging tails do not change (doc/model.md, section 12).
///
/// Each tail is cut level with its coil's outermost point plus h, or where it turns back before (OverhandStrand). From
/// the cut the closure runs on along the load axis, around the threaded strand by the angle theta that the cut has gone
/// around, and straight out to far away, where both closures meet. theta is followed from one reading to the next, so a
/// tail may go around the strand any number of times, if it gains less than half a turn in between. A tail whose end
/// slips out of its coil leaves no turn to be followed, and the knot is lost.
///
/// Source: knots of open chains by their closure, e.g. Tubiana, Orlandini, Micheletti 2011; here the closure is fixed
/// to the strands rather than averaged over directions.
class LoopTopology {
 public:
  struct Reading {
    KnotPolynomial polynomial;                           ///< of the loop closed by joining its tails
    std::int64_t determinant = 0;                        ///< |Delta(-1)| of it
    int linking = 0;                                     ///< of the two halves, each closed on its own
    std::array<std::int64_t, 2> overhand_determinant{};  ///< of each overhand alone, lower first: 3; of n windings 2n+1
    std::array<bool, 2> coil_found{};                    ///< the strand turns back and forth as an overhand's does

    /// Whether this is the same knot, made of the same two overhands.
    bool same_knot(const Reading& other) const;
    /// Whether at least the two overhands are the same.
    bool same_overhands(const Reading& other) const;
  };

  /// `lower_standing`, `upper_standing`: a node in the standing part of the lower knot, tied into the rod's first end,
  /// and of the upper, tied into its last; `radius`: of the rod [m]; `windings`: of each tail (OverhandStrand).
  LoopTopology(Eigen::Index lower_standing, Eigen::Index upper_standing, double radius, int windings = 1);

  /// Rises of each strand that are its coil's own (OverhandStrand).
  using PassedOver = std::array<int, 2>;

  /// Reads the rod as it is now. `load_axis`: from the lower grip to the upper one, of any length.
  Reading read(const Points& points, const Vec3& load_axis, const PassedOver& passed_over = {});

  /// The same for a rod that was the knot `known`. Where the overhands are still the same and the whole is not, a tail
  /// may have gone around further than could be followed, as when a knot springs open; a free end can do so without
  /// undoing the knot. Then up to two more turns of each tail, either way, are tried, and kept where they give `known`.
  /// So are rises of a coil that lies aslant, or whose windings do (OverhandStrand).
  Reading read_as(const Reading& known, const Points& points, const Vec3& load_axis);

  /// Saves or loads the angles theta of both tails.
  void state(Archive& archive) { archive(angle_[0], angle_[1]); }

 private:
  OverhandStrand follow(const Points& points, const Vec3& axis, std::size_t k, int passed_over) const;
  /// For each overhand, the number of rises to be passed over so that it is the known one; 0 if no number does.
  PassedOver passed_over(const Reading& known, const Reading& found, const Points& points, const Vec3& axis) const;

  std::array<Eigen::Index, 2> standing_;
  double radius_;
  int windings_;
  std::array<double, 2> angle_{};
};

}  // namespace knot_utm
