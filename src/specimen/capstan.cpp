#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>

#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "path.hpp"

namespace knot_utm {
namespace {

constexpr double kPost = 12.0;          // diameter, as that of the paper's rollers [h]
constexpr double kStrand = 30.0;        // of the tail, and from the post to the grip [h]
constexpr double kEdgesARadian = 4.0;   // by default: the tension ratio is then right within half a percent
constexpr double kFewestARadian = 2.0;  // edges that are allowed
constexpr double kPull = 1.5;           // by then the rod slides everywhere on the post [rho]
constexpr double kBeyondPull = 15.0;    // of tail left after a pull, so that its end keeps off the post [h]
constexpr double kLeastTail = 3.0;      // the same, at least [h]
constexpr double kTailStrain = 0.01;    // by the default load: a strand that stretches more slides too late
constexpr double kMostStrain = 1.0;     // by the tail load: a sketched shape is not stretched [-]
constexpr double kPitch = 4.0;          // of a helix, so that strands side by side do not touch [h]

double bend_radius(const SpecimenOptions& specimen, double h) { return 0.5 * specimen.post_diameter + h; }

/// The wrapped part of the rod, tilted so that its upper end runs along z.
class Winding {
 public:
  Winding(const SpecimenOptions& specimen, double h) : rho_(bend_radius(specimen, h)) {
    const double rise = specimen.wrap > M_PI ? kPitch * h / (2.0 * M_PI) : 0.0;  // a radian about the axis
    a_radian_ = std::hypot(rho_, rise);
    rise_ = rise;
    // The tangent turns by rho/a_radian for each radian about the axis.
    angle_ = specimen.wrap * a_radian_ / rho_;
    tilt_ = Eigen::AngleAxisd(std::atan2(rise, rho_), Vec3::UnitX()).toRotationMatrix();
  }

  double length() const { return angle_ * a_radian_; }
  Vec3 axis() const { return tilt_ * Vec3::UnitY(); }

  /// At an arclength from its upper end backwards; straight on beyond both ends.
  Vec3 at(double back) const {
    const double on = std::clamp(back, 0.0, length());
    const double angle = -on / a_radian_;
    const Vec3 place(rho_ * std::cos(angle), rise_ * angle, rho_ * std::sin(angle));
    return tilt_ * place - (back - on) * tangent(on);
  }

  /// Towards the upper end.
  Vec3 tangent(double back) const {
    const double angle = -back / a_radian_;
    return tilt_ * Vec3(-rho_ * std::sin(angle), rise_, rho_ * std::cos(angle)) / a_radian_;
  }

 private:
  double rho_, rise_ = 0.0;
  double a_radian_ = 0.0;  // arclength of a radian about the axis [m]
  double angle_ = 0.0;     // about the axis [rad]
  Mat3 tilt_;
};

/// The rod must bear the load, and the sketched shape, which is not stretched, must be able to take the strain.
void check_tail_load(const SpecimenOptions& specimen, const Material& material) {
  const double load = tail_load(specimen, material);
  if (material.breaking_force && load >= *material.breaking_force)
    throw InvalidInput("specimen.tail_load", text(load),
                       "less than material.breaking_force, " + text(*material.breaking_force) + " N");
  const double strain = strain_under(material, load);
  if (strain > kMostStrain)
    throw InvalidInput(
        "specimen.tail_load", text(load),
        "one that stretches the rod to at most twice its length, and not to " + text(1.0 + strain) + " times that");
}

/// knot: capstan. A rod lies around a fixed post by the angle `wrap` [rad]. A dead load T1, `tail_load` [N], pulls at
/// its first node along the `tail` [m], as a weight does over a pulley that turns freely. The upper grip pulls its last
/// node along +z with T2. A rod without bending stiffness that slides has T2/T1 = exp(mu wrap), mu being
/// `machine.roller_friction`.
///
/// The rod's centreline lies on a circle of radius rho = post_diameter/2 + h around the post's axis, which goes through
/// the origin along y. Beyond half a turn the tails would cross. The rod then lies on a helix of pitch 4 h, whose
/// tangents turn by `wrap` in all, and the axis is tilted so that the strand to the grip still runs along z.
class CapstanSpecimen final : public Knot {
 public:
  CapstanSpecimen() {
    about_.name = "capstan";
    about_.title = "Strand around a post (capstan)";
    about_.keys = {"wrap", "post_diameter", "tail_load", "tail", "end_to_end"};
  }

  SpecimenOptions defaults(double h) const override {
    SpecimenOptions out;
    out.edge_length = kPaperEdge * (h / kPaperRadius);
    out.post_diameter = kPost * h;
    out.tail = out.end_to_end = kStrand * h;
    return out;
  }

  void suit(const SpecimenOptions& known, double, double h, SpecimenOptions& out) const override {
    out.edge_length = std::min(kPaperEdge * (h / kPaperRadius), bend_radius(known, h) / kEdgesARadian);
    out.tail = std::max(kStrand * h, pull(known, h) + kBeyondPull * h);
  }

  std::optional<double> longest_pull(const SpecimenOptions& specimen, double h) const override {
    return specimen.tail - kLeastTail * h;
  }

  double pull(const SpecimenOptions& specimen, double h) const override { return kPull * bend_radius(specimen, h); }

  void check(const SpecimenOptions& specimen, double h) const override {
    const double longest = bend_radius(specimen, h) / kFewestARadian;
    if (specimen.edge_length > longest)
      throw InvalidInput("specimen.edge_length", text(specimen.edge_length),
                         "at most " + most_text(longest) + " m, half the radius of the bend around the post");
  }

  Centreline centreline(const SpecimenOptions& specimen, const Material& material, const Mounting&) const override {
    check_tail_load(specimen, material);
    const Winding winding(specimen, material.radius);
    const double length = specimen.tail + winding.length() + specimen.end_to_end;
    const int edges = std::max(4, static_cast<int>(std::lround(length / specimen.edge_length)));
    Centreline out;
    out.points.resize(3, edges + 1);
    for (int i = 0; i <= edges; ++i) out.points.col(i) = winding.at(length * (edges - i) / edges - specimen.end_to_end);
    return out;
  }

  Supports supports(const SpecimenOptions& specimen, const Material& material) const override {
    const Winding winding(specimen, material.radius);
    Supports out;
    Roller post;
    post.axis = winding.axis();
    post.radius = 0.5 * specimen.post_diameter;
    out.posts.push_back(post);
    out.loads.push_back({0, -tail_load(specimen, material) * winding.tangent(winding.length())});
    return out;
  }
};

}  // namespace

double tail_load(const SpecimenOptions& specimen, const Material& material) {
  return specimen.tail_load.value_or(
      std::min(specimen_scales(material).force, kTailStrain * material.stretching_stiffness));
}

std::unique_ptr<const Knot> capstan() { return std::make_unique<CapstanSpecimen>(); }

}  // namespace knot_utm
