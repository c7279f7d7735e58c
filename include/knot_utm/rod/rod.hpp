#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/material.hpp"

namespace knot_utm {

struct RodLaws;

/// Whether all of them are numbers, and none is further than 1000 km from the origin.
bool are_places(const Points& points);

/// What stays constant while the rod moves: N nodes, N-1 edges, N-2 inner nodes.
/// Symbols: l_j rest length of edge j, lbar_i = (l_{i-1}+l_i)/2 Voronoi length of node i.
///
/// Several ropes are one rod with cut edges. A cut edge joins the last node of a rope to the first one of the next, and
/// has no mass and no stiffness, nor do nodes bend or twist at its ends. Its l_j is no length of rod: it only keeps the
/// two ropes further apart along the rod than where a strand touches itself (least_loop in contact/candidates.hpp).
///
/// The ropes behind the first one may be of another material, with laws of the same kinds.
struct RodProperties {
  RodMaterial material;                 ///< of all ropes, or of the first one
  std::shared_ptr<const RodLaws> laws;  ///< of stretching and bending (rod_laws.hpp)
  /// Of the ropes behind the first one, where they are of another material.
  std::optional<RodMaterial> other_material;
  std::shared_ptr<const RodLaws> other_laws;  ///< null where there is none
  Eigen::VectorXd rest_length;                ///< l_j [m], N-1
  Eigen::VectorXd voronoi_length;             ///< lbar_i [m], N (half an edge at the ends)
  Eigen::VectorXd mass;                       ///< m_i [kg], N
  std::vector<int> cuts;                      ///< edges that are cut, ascending

  Eigen::Index nodes() const { return voronoi_length.size(); }
  Eigen::Index edges() const { return rest_length.size(); }
  bool is_cut(Eigen::Index edge) const;
  /// The first node and edge of the other material; there is none from nodes() on.
  Eigen::Index first_of_other() const { return other_material ? cuts.front() + 1 : nodes(); }
  /// Of a node, or of an edge that is not cut.
  const RodMaterial& material_at(Eigen::Index node) const {
    return node < first_of_other() ? material : *other_material;
  }
  double thinnest() const;  ///< radius of the thinnest rope [m]
  const RodLaws& laws_at(Eigen::Index node) const { return node < first_of_other() ? *laws : *other_laws; }
  double length() const;  ///< of all ropes [m]
  /// Arclength at rest of every node from the first, with the l_j of cut edges [m], N
  Eigen::VectorXd arclength() const;
  /// Of such an arclength, or of a place on an edge, without the l_j of cut edges: along all ropes, one behind the
  /// other, as people are told [m].
  double place(double arclength) const;
  double place(Eigen::Index edge, double fraction) const;
};

/// Straight, untwisted rod of the given rest lengths, by the laws of its material: masses rho pi h^2 lbar_i. What
/// `rest_length` says of cut edges does not count.
RodProperties make_rod(const RodMaterial& material, const Eigen::VectorXd& rest_length,
                       const std::vector<int>& cuts = {});
/// The same with ropes behind the first one of another material. Throws InvalidInput where there are none, or where the
/// two materials have laws of different kinds.
RodProperties make_rod(const RodMaterial& material, const RodMaterial& other, const Eigen::VectorXd& rest_length,
                       const std::vector<int>& cuts);

/// What moves, and what the bending law of the rod remembers. Twist members are empty where the scene does not solve
/// for twist.
struct RodState {
  Points position;                  ///< x_i [m], 3 x N
  Points velocity;                  ///< v_i [m/s], 3 x N
  Eigen::VectorXd twist;            ///< theta_j [rad] of the material frame against the reference frame, N-1
  Eigen::VectorXd twist_rate;       ///< [rad/s], N-1
  Points reference_director;        ///< d1_j, unit, normal to edge j, 3 x (N-1)
  Eigen::VectorXd reference_twist;  ///< m_ref of inner node i+1 [rad], N-2

  /// What the bending law remembers: kappa-bar of inner node i+1 on (m1, m2), the angle it turns by at rest [rad], N-2.
  /// Empty: straight at rest for good. Zeros: straight until its law changes that.
  Eigen::Matrix2Xd natural_curvature;
  Eigen::VectorXd bending_own;  ///< and its own numbers (bending_law.hpp): kOwn of each of these nodes, node by node

  bool curved_at_rest() const { return natural_curvature.cols() > 0; }

  void state(Archive& archive);
};

/// Gives the state natural curvatures of zero, and the memory that the rod's bending law needs.
void remember_bends(const RodProperties& rod, RodState* state);

/// Throws InvalidInput where state and rod do not fit together: other numbers of nodes, or a rod that needs frames or a
/// memory of its bends which the state has not.
void require_fits(const RodProperties& rod, const RodState& state);

}  // namespace knot_utm
