#include "knot_utm/ros/views.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace knot_utm {
namespace {

constexpr double kFollow = 0.25;  // fraction of the distance to the knots that a look at them goes with each picture
constexpr double kClose = 9.0;    // half of the width of one knot seen alone [radius]

Look look_at(const Box& box) { return {box.middle(), Camera::eye_for(box)}; }

void follow(Look& look, const Look& wanted) {
  look.at += kFollow * (wanted.at - look.at);
  look.from += kFollow * (wanted.from - look.from);
}

/// Before these the specimen is another thing to look at than after them.
bool looks_anew(Phase phase) { return ends_by_itself(phase); }

}  // namespace

Vec3 Camera::forwards() {
  return {std::cos(kPitch) * std::cos(kYaw), std::cos(kPitch) * std::sin(kYaw), -std::sin(kPitch)};
}

Vec3 Camera::right() { return {std::sin(kYaw), -std::cos(kYaw), 0.0}; }

Vec3 Camera::up() { return {std::sin(kPitch) * std::cos(kYaw), std::sin(kPitch) * std::sin(kYaw), std::cos(kPitch)}; }

Vec3 Camera::project(const Vec3& eye, const Vec3& point) {
  const Vec3 offset = point - eye;
  const double ahead = offset.dot(forwards());
  const double half_height = ahead * std::tan(0.5 * kFieldOfView);
  return {offset.dot(right()) / half_height, offset.dot(up()) / half_height, ahead};
}

Vec3 Camera::eye_for(const Box& box) {
  const double half_height = kFilled * std::tan(0.5 * kFieldOfView);
  const double half_width = kNarrowest * half_height;
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point((corner & 1) != 0 ? box.high.x() : box.low.x(), (corner & 2) != 0 ? box.high.y() : box.low.y(),
                     (corner & 4) != 0 ? box.high.z() : box.low.z());
    const Vec3 offset = point - box.middle();
    const double sideways =
        std::max(std::abs(offset.dot(up())) / half_height, std::abs(offset.dot(right())) / half_width);
    distance = std::max(distance, sideways - offset.dot(forwards()));
  }
  return box.middle() - distance * forwards();
}

Looks Views::look(const Points& points, const Vec3& lower_grip, const Vec3& upper_grip, const Sample& sample) {
  const bool anew = !seen_ || (sample.phase != phase_ && looks_anew(sample.phase));
  seen_ = true;
  phase_ = sample.phase;
  if (anew) all_ = {lower_grip, lower_grip};
  for (const GripBody& body : bodies_) {
    const Vec3 middle = (body.goes_up ? upper_grip : lower_grip) + body.from_grip, half = body.half_box(radius_);
    all_.take_in(middle - half);
    all_.take_in(middle + half);
  }
  if (points.cols() > 0) {
    all_.take_in(points.rowwise().minCoeff() - Vec3::Constant(radius_));
    all_.take_in(points.rowwise().maxCoeff() + Vec3::Constant(radius_));
  }
  Looks now;
  now.machine = now.knots = now.lower_knot = now.upper_knot = look_at(all_);
  if (const std::optional<KnotPlaces> found = find_knots(points, radius_, std::isfinite(sample.knot_distance), cuts_)) {
    const Vec3 close = Vec3::Constant(kClose * radius_);
    now.knots = look_at(found->all);
    now.lower_knot = look_at(Box::around(found->lower, close));
    now.upper_knot = look_at(Box::around(found->upper, close));
  }
  if (anew) return last_ = now;
  last_.machine = now.machine;
  follow(last_.knots, now.knots);
  follow(last_.lower_knot, now.lower_knot);
  follow(last_.upper_knot, now.upper_knot);
  return last_;
}

}  // namespace knot_utm
