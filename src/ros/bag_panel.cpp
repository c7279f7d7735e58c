#include "knot_utm/ros/bag_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "knot_utm/record/phase.hpp"
#include "knot_utm/ros/base_marker.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

using visualization_msgs::Marker;

constexpr std::size_t kMostPoints = 120;  // of a curve
constexpr double kMany = 8.0;             // loads above this many of those of sliding hide them
constexpr double kSmall = 2.5;            // end of the axis of small loads, of the load of sliding

// Lengths and places are in halves of the height of the panel.
constexpr double kBefore = 0.01;  // of a curve, before its axes
// Each line is a text of its own: rviz sets the lines of one text 1 cm apart, however small the panel is.
constexpr double kLetter = 0.042;            // height of the readings' letters
constexpr double kSmallLetter = 0.032;       // of those at the axes
constexpr double kLine = 0.005;              // width of lines
constexpr double kText = -1.1;               // middle of the readings
constexpr double kTop = 0.42, kRow = 0.092;  // of the readings

struct Box2 {
  double left, right, low, high;
};
constexpr Box2 kAlone{0.92, 1.46, -0.4, 0.5}, kUpper{0.92, 1.46, 0.14, 0.72}, kLower{0.92, 1.46, -0.64, -0.06};

const std_msgs::ColorRGBA kWhite = color(0.95, 0.95, 0.95), kGrey = color(0.66, 0.68, 0.72);
const std_msgs::ColorRGBA kFaint = color(0.36, 0.37, 0.42), kYellow = color(1.0, 0.77, 0.19);

/// 1, 1.5, 2, 3, 5 or 7 times a power of ten, a twentieth beyond the value at least: an axis then seldom changes.
double axis_end(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(1.05 * value)));
  for (const double digit : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0})
    if (1.05 * value <= digit * power * (1.0 + 1e-9)) return digit * power;
  return 10.0 * power;
}

std::string short_text(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value + 0.0);
  return text.data();
}

/// Draws in the plane of the panel.
class Plane {
 public:
  Plane(const Vec3& middle, double half_height) : middle_(middle), half_height_(half_height) {}

  Marker text(int id, const std::string& words, double letter, double x, double y) const {
    Marker m = base_marker(names::kBaseFrame, "reading", id, Marker::TEXT_VIEW_FACING);
    m.color = kGrey;
    m.scale.z = letter * half_height_;
    m.pose.position = at(x, y);
    m.text = words;
    return m;
  }
  Marker lines(int id, const char* ns, const std_msgs::ColorRGBA& c) const {
    Marker m = base_marker(names::kBaseFrame, ns, id, Marker::LINE_LIST);
    m.color = c;
    m.scale.x = kLine * half_height_;
    return m;
  }
  geometry_msgs::Point at(double x, double y, double before = 0.0) const {
    return to_point(middle_ + half_height_ * Vec3(x, -before, y));
  }

 private:
  Vec3 middle_;
  double half_height_;
};

/// Axes in a box, from 0 or less to their ends.
struct Axes {
  Box2 box;
  double extension, lowest_load, load;

  double x(double s) const { return box.left + (box.right - box.left) * s / extension; }
  double y(double f) const { return box.low + (box.high - box.low) * (f - lowest_load) / (load - lowest_load); }
};

/// Box, middle lines, and what the axes say. Eight markers.
void add_axes(const Plane& plane, const Axes& axes, int id, const char* name, std::vector<Marker>& out) {
  const Box2& b = axes.box;
  Marker lines = plane.lines(id, "axes", kFaint);
  for (int i = 0; i <= 2; ++i) {
    const double x = b.left + 0.5 * i * (b.right - b.left), y = b.low + 0.5 * i * (b.high - b.low);
    for (const auto& end : {plane.at(x, b.low), plane.at(x, b.high), plane.at(b.left, y), plane.at(b.right, y)})
      lines.points.push_back(end);
  }
  out.push_back(lines);
  const double middle = 0.5 * (b.left + b.right);
  const std::array<Marker, 6> texts{
      plane.text(id + 1, name, kSmallLetter, middle, b.high + 0.06),
      plane.text(id + 2, short_text("%.4g", axes.load), kSmallLetter, b.left - 0.09, b.high),
      plane.text(id + 3, short_text("%.4g", axes.lowest_load), kSmallLetter, b.left - 0.09, b.low),
      plane.text(id + 4, "0", kSmallLetter, b.left, b.low - 0.06),
      plane.text(id + 5, short_text("%.4g", 1e3 * axes.extension), kSmallLetter, b.right, b.low - 0.06),
      plane.text(id + 6, "extension [mm]", kSmallLetter, middle, b.low - 0.06)};
  out.insert(out.end(), texts.begin(), texts.end());
}

/// What lies within the axes of the way between two points, as fractions of that way.
std::array<double, 2> inside(const Axes& axes, double from, double to) {
  const auto part = [&](double load) { return std::clamp((load - from) / (to - from), 0.0, 1.0); };
  const double low = axes.lowest_load, high = axes.load;
  return {from > high ? part(high) : from < low ? part(low) : 0.0, to > high ? part(high) : to < low ? part(low) : 1.0};
}

template <class Points>
void add_curve(const Plane& plane, const Axes& axes, int id, const Points& points, std::vector<Marker>& out) {
  Marker curve = plane.lines(id, "curve", kYellow);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto &a = points[i - 1], &b = points[i];
    if (std::min(a.load, b.load) > axes.load || std::max(a.load, b.load) < axes.lowest_load) continue;
    for (const double t : inside(axes, a.load, b.load))
      curve.points.push_back(plane.at(axes.x(std::max(0.0, a.extension + t * (b.extension - a.extension))),
                                      axes.y(a.load + t * (b.load - a.load)), kBefore));
  }
  if (!curve.points.empty()) out.push_back(curve);
}

}  // namespace

std::string condition_of(const Sample& sample, const std::string& motion_pattern) {
  if (sample.status == BenchStatus::kBroken) return "broke";
  if (sample.status == BenchStatus::kFailed) return "the physics gave up";
  if (sample.knot_type == KnotType::kCrossed) return "ran through itself";
  if (motion_pattern != "untangling") return "running";
  return sample.knot_type == KnotType::kKept ? "a knot opened" : "came undone";
}

void BagPanel::add(const Sample& reading, bool slides) {
  if (prepares(reading.phase) && reading.phase != Phase::kBalance) return;
  if (reading.balance_offset != zero_) {
    points_.clear();
    readings_ = 0;
    stride_ = 1;
  }
  zero_ = reading.balance_offset;
  const bool latest_is_kept = readings_ == 0 || (readings_ - 1) % stride_ == 0;
  if (!latest_is_kept) points_.pop_back();
  if (latest_is_kept && points_.size() >= kMostPoints) {
    for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
    points_.resize((points_.size() + 1) / 2);
    stride_ *= 2;
  }
  points_.push_back({reading.extension, reading.load, slides});
  ++readings_;
}

double BagPanel::small_load() const {
  std::vector<double> sliding;
  double largest = 0.0;
  for (const Point& point : points_) {
    largest = std::max(largest, point.load);
    if (point.slides) sliding.push_back(point.load);
  }
  if (sliding.empty()) return 0.0;
  const auto middle = sliding.begin() + static_cast<std::ptrdiff_t>(sliding.size() / 2);
  std::nth_element(sliding.begin(), middle, sliding.end());
  return *middle > 0.0 && largest > kMany * *middle ? axis_end(kSmall * *middle) : 0.0;
}

std::vector<std::string> BagPanel::lines(const Sample& sample, const std::string& motion_pattern,
                                         const ColorScale& scale) const {
  const bool parted = sample.status == BenchStatus::kBroken;
  std::vector<std::string> out{
      title_,
      short_text("time %.1f s", sample.time),
      "state: " + condition_of(sample, motion_pattern),
      std::string("phase: ") + phase_name(sample.phase),
      "motion pattern: " + motion_pattern,
      short_text("extension %.1f mm", 1e3 * sample.extension),
      parted ? short_text("load at the break %.4g N", sample.highest_load) : short_text("load %.4g N", sample.load),
      short_text("end-to-end distance %.1f mm", 1e3 * sample.end_to_end)};
  if (!std::isnan(sample.knot_distance)) out.push_back(short_text("knot distance %.1f mm", 1e3 * sample.knot_distance));
  out.push_back(parted ? "grey: tension not known" : short_text("colours: grey 0, red %g N", scale.full()));
  return out;
}

std::vector<Marker> BagPanel::draw(const Sample& sample, const std::string& motion_pattern,
                                   const ColorScale& scale) const {
  const Plane plane(middle_, half_height_);
  std::vector<Marker> out;
  for (const std::string& line : lines(sample, motion_pattern, scale)) {
    const int row = static_cast<int>(out.size());
    out.push_back(plane.text(row, line, kLetter, kText, kTop - kRow * row));
    out.back().color = kWhite;
  }
  double extension = 0.0, lowest = 0.0, highest = 0.0;
  for (const Point& point : points_) {
    extension = std::max(extension, point.extension);
    lowest = std::min(lowest, point.load);
    highest = std::max(highest, point.load);
  }
  if (!(extension > 0.0) || !(highest > 0.0)) return out;
  const double small = small_load();
  const double floor = lowest < -1e-3 * highest ? -axis_end(-lowest) : 0.0;
  const Axes all{small > 0.0 ? kUpper : kAlone, axis_end(extension), floor, axis_end(highest)};
  const Axes few{kLower, all.extension, std::max(floor, -0.3 * small), small};
  add_axes(plane, all, 10, "load [N]", out);
  if (small > 0.0) add_axes(plane, few, 20, "small loads [N]", out);
  add_curve(plane, all, 0, points_, out);
  if (small > 0.0) add_curve(plane, few, 1, points_, out);
  return out;
}

}  // namespace knot_utm
