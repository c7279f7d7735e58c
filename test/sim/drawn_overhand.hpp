#pragma once

#include <cmath>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/overhand.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {

/// An overhand in 0.6 m of rod whose ends are 0.35 m apart, as it is drawn, at rest.
struct DrawnOverhand {
  RodProperties rod;
  RodState state;

  explicit DrawnOverhand(const Material& material, double refinement = 1.0) {
    OverhandShape shape;
    shape.radius = material.radius;
    shape.length = 0.6;
    shape.end_to_end = 0.35;
    shape.refinement = refinement;
    state.position = overhand(shape).points;
    const Eigen::Index edges = state.position.cols() - 1;
    rod = make_rod(material, (state.position.rightCols(edges) - state.position.leftCols(edges)).colwise().norm());
    state.velocity = Points::Zero(3, rod.nodes());
  }

  /// Both ends held where they are.
  Boundary held() const {
    Boundary out;
    for (const int node : {0, static_cast<int>(rod.nodes()) - 1})
      out.fixed_nodes.push_back({node, state.position.col(node)});
    return out;
  }
};

/// Settings in which the strands of a knot press on each other as those of a rope do, and slide with its friction.
inline StepSettings sliding_settings(const Material& material) {
  StepSettings out = closed_form_settings(material);
  out.friction = MemoryFriction{material.friction_coefficient, 1e-3 * material.radius};
  out.pressure_law =
      NormalLaw{300.0 * material.bending_stiffness / std::pow(material.radius, 4.0), 0.05 * material.radius};
  out.drag = 1.0;
  out.residual = 1e-4;
  return out;
}

}  // namespace knot_utm
