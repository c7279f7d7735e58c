#pragma once

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

struct RodState;

/// Frames along a discrete rod, one orthonormal right-handed triad on each edge.
///
///   reference frame  (d1, d2, t),  d2 = t x d1: carried along in time without spinning about t
///   material frame   (m1, m2, t),  m1 = cos(theta) d1 + sin(theta) d2,  m2 = -sin(theta) d1 + cos(theta) d2
///   parallel transport P from t to t': the rotation about t x t' that takes t to t'
///   reference twist  m_ref of inner node i: angle about t_i from P(d1_{i-1}) to d1_i, as P goes from t_{i-1} to t_i
///   twist            m_i = theta_i - theta_{i-1} + m_ref,i
///
/// Angles in rad, positive by the right-hand rule about the tangent, which points to growing node numbers.
/// m_ref is followed through time, so it does not jump by a turn when a strand winds up.
/// Source: Bergou et al. 2008, section 4.2; Bergou et al. 2010, section 3.

/// Vector w parallel-transported from unit tangent `from` to unit tangent `to`. Where the two are opposite the
/// rotation is not unique, and a half turn about a normal that depends on `from` alone is taken.
Vec3 parallel_transport(const Vec3& w, const Vec3& from, const Vec3& to);

/// A unit vector normal to the unit vector t.
Vec3 any_normal(const Vec3& t);

/// Unit tangents of the edges, 3 x (N-1).
Points tangents(const Points& position);

/// Directors d1 of the frame without twist: `first` (its part normal to the first edge) is transported from edge to
/// edge along the rod. 3 x (N-1).
Points space_parallel_directors(const Points& position, const Vec3& first);

/// Signed angle [rad] in (-pi, pi] from unit vector a to unit vector b about the axis, all normal to it.
double signed_angle(const Vec3& a, const Vec3& b, const Vec3& axis);

/// Angle [rad] in (-pi, pi] by which director d1_f on tangent t_f is turned against d1_e transported from t_e.
double reference_twist(const Vec3& d1_e, const Vec3& t_e, const Vec3& d1_f, const Vec3& t_f);

struct Directors {
  Vec3 m1;
  Vec3 m2;
};

/// Material directors of an edge of unit tangent t with reference director d1, turned by theta [rad].
Directors material_directors(const Vec3& t, const Vec3& d1, double theta);

/// Gives the state a frame without twist for its positions: space-parallel reference directors, theta = 0,
/// theta rate = 0 and m_ref = 0.
void initialise_frames(RodState* state);

/// Director d1 of tangent `from` transported to tangent `to`, then made exactly normal to it and of unit length, so
/// that rounding does not add up over many transports.
Vec3 transported_director(const Vec3& d1, const Vec3& from, const Vec3& to);

/// The angle that differs from `angle` by whole turns and lies nearest to `last` [rad].
double nearest_turn(double angle, double last);

/// Carries the reference frame along with positions that have moved from `position_before`: d1 by parallel transport in
/// time, edge by edge, then m_ref. To be called once for an accepted step, or on a copy for a trial step.
void transport_frames(const Points& position_before, RodState* state);

}  // namespace knot_utm
