#include "path.hpp"

#include <array>
#include <cstdio>
#include <sstream>

#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {

namespace {

double interpolate(const std::vector<double>& values, double at) {
  const double last = static_cast<double>(values.size() - 1);
  const double x = std::clamp(at, 0.0, last);
  const auto i = std::min(static_cast<std::size_t>(x), values.size() - 2);
  return values[i] + (x - static_cast<double>(i)) * (values[i + 1] - values[i]);
}

}  // namespace

Points smoothed(const Path& path, double deviation, double spacing) {
  const auto pieces = static_cast<Eigen::Index>(std::ceil(path.length() / spacing));
  const double step = path.length() / static_cast<double>(pieces);
  const auto reach = static_cast<Eigen::Index>(std::ceil(5.0 * deviation / step));
  Points raw(3, pieces + 1 + 2 * reach);
  for (Eigen::Index i = 0; i < raw.cols(); ++i) raw.col(i) = path.at(static_cast<double>(i - reach) * step);
  Eigen::VectorXd weight(2 * reach + 1);
  for (Eigen::Index i = -reach; i <= reach; ++i) {
    const double x = static_cast<double>(i) * step / deviation;
    weight[i + reach] = std::exp(-0.5 * x * x);
  }
  weight /= weight.sum();
  Points smooth(3, pieces + 1);
  for (Eigen::Index i = 0; i <= pieces; ++i) smooth.col(i).noalias() = raw.middleCols(i, 2 * reach + 1) * weight;
  return smooth;
}

Resampled::Resampled(const Path& path, const Points& smooth, const EdgeGrading& wanted)
    : path_length_(path.length()), arclength_(arclengths(smooth)) {
  EdgeGrading on_the_smooth = wanted;
  for (EdgeGrading::Zone& zone : on_the_smooth.zones) {
    zone.begin = on_smooth(zone.begin);
    zone.end = on_smooth(zone.end);
  }
  points = resample_graded(smooth, on_the_smooth, &node_position_);
  node_arclength_ = arclengths(points);
}

double Resampled::on_smooth(double s) const {
  return interpolate(arclength_, s / path_length_ * static_cast<double>(arclength_.size() - 1));
}

double Resampled::operator()(double s) const {
  const double fine = on_smooth(s);
  const auto next = std::upper_bound(node_position_.begin() + 1, node_position_.end() - 1, fine);
  const auto i = static_cast<std::size_t>(next - node_position_.begin());
  const double t = std::clamp((fine - node_position_[i - 1]) / (node_position_[i] - node_position_[i - 1]), 0.0, 1.0);
  return node_arclength_[i - 1] + t * (node_arclength_[i] - node_arclength_[i - 1]);
}

std::string text(double value) {
  std::ostringstream out;
  out.precision(4);
  out << value;
  return out.str();
}

std::string place_text(const Vec3& place) {
  std::array<char, 96> out{};
  const Vec3 at = place.array() + 0.0;  // no minus before a zero
  std::snprintf(out.data(), out.size(), "(%.1f, %.1f, %.1f)", at.x(), at.y(), at.z());
  return out.data();
}

void check_edge_length(double edge_length, double radius) {
  if (!(edge_length >= 0.05 * radius && edge_length <= 2.0 * radius))
    throw InvalidInput("specimen.edge_length", text(edge_length),
                       limits_text(0.05 * radius, 2.0 * radius) + " m: at most the rod's diameter");
}

void check_edges_of_length(const SpecimenOptions& specimen) {
  if (specimen.edge_length > specimen.length / 4.0)
    throw InvalidInput("specimen.edge_length", format_number(specimen.edge_length),
                       "at most a quarter of length, " + most_text(specimen.length / 4.0) + " m");
}

void check_radius(double radius) {
  if (!(radius > 0.0 && radius < 1.0)) throw InvalidInput("material.radius", text(radius), "above 0 and below 1 m");
}

}  // namespace knot_utm
