#pragma once

#include <Eigen/Core>
#include <functional>

namespace knot_utm {

/// Central difference of fourth order of a vector function: column j is df/dx_j.
inline Eigen::MatrixXd finite_difference(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function,
                                         const Eigen::VectorXd& x, double step) {
  const auto at = [&](Eigen::Index j, double shift) {
    Eigen::VectorXd moved = x;
    moved[j] += shift;
    return function(moved);
  };
  Eigen::MatrixXd derivative(function(x).size(), x.size());
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    derivative.col(j) = (8.0 * (at(j, step) - at(j, -step)) - (at(j, 2.0 * step) - at(j, -2.0 * step))) / (12.0 * step);
  }
  return derivative;
}

/// The gradient of a scalar function, as a column.
inline Eigen::VectorXd finite_difference_gradient(const std::function<double(const Eigen::VectorXd&)>& function,
                                                  const Eigen::VectorXd& x, double step) {
  const auto as_vector = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd value(1);
    value[0] = function(at);
    return value;
  };
  return finite_difference(as_vector, x, step).transpose();
}

/// Largest entry of a - b over the largest entry of b.
inline double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}  // namespace knot_utm
