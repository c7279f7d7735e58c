#include "knot_utm/rod/half_turn.hpp"

#include <Eigen/Eigenvalues>

namespace knot_utm {
namespace {

constexpr int kLeastNodes = 16;    // fewer have no half that is worth it
constexpr double kAligned = 1e-9;  // a component of the axis below it is zero: the turn is then exact

}  // namespace

std::optional<HalfTurn> HalfTurn::of(const Points& shape, double tolerance) {
  if (shape.cols() < kLeastNodes) return {};
  // What leads from a node to its image lies across the axis, and its middle on the axis.
  const Points image = shape.rowwise().reverse(), across = image - shape;
  const Points middle = (0.5 * (image + shape)).colwise() - shape.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(across * across.transpose() - middle * middle.transpose());
  Vec3 axis = axes.eigenvectors().col(0);
  axis = (axis.array().abs() < kAligned).select(0.0, axis).normalized();
  HalfTurn out;
  out.nodes = static_cast<int>(shape.cols());
  out.turn = 2.0 * axis * axis.transpose() - Mat3::Identity();
  out.aligned = axis.cwiseAbs().maxCoeff() == 1.0;
  for (int k = 0; k < 3; ++k) out.column[k] = to_lanes(Vec3(out.turn.col(k)));
  out.shift = (image - out.turn * shape).rowwise().mean();
  const double off2 = ((image - out.turn * shape).colwise() - out.shift).colwise().squaredNorm().maxCoeff();
  if (!(off2 <= tolerance * tolerance)) return {};
  return out;
}

void HalfTurn::spread(const std::vector<Lanes>& first, std::vector<Lanes>& all) const {
  for (int i = 0; i < nodes; ++i) all[at(i)] = i < half() ? first[at(i)] : image_of(first, i);
}

void HalfTurn::fold(const std::vector<Lanes>& all, std::vector<Lanes>& first) const {
  for (int i = 0; i < half(); ++i) first[at(i)] += all[at(i)] + image_of(all, i);
}

}  // namespace knot_utm
