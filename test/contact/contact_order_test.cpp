// Where along the rod contact begins and ends: strands touch from half a turn around their own radius on, and a strand
// that slips over the end of another one loses its force before it does. And which length the points of a segment stand
// for, and how true the force and the distance of bent strands are for the length of their edges. Lengths in radii of
// the rod.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "contact/nodal_forces.hpp"
#include "contact/strands.hpp"
#include "knot_utm/contact/centreline_curve.hpp"
#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kEdge = 0.2;
constexpr NormalLaw kNormal = {1.0, 0.01};
constexpr double kMargin = 0.5;

/// Two straight legs joined by half a turn, with their centrelines `apart`.
Points hairpin(double apart) {
  const double radius = 0.5 * apart, turn = kPi * radius;
  const int turning = static_cast<int>(std::round(turn / kEdge)), leg = 40;
  Points out(3, 2 * leg + turning + 1);
  for (int i = 0; i < out.cols(); ++i) {
    const int on_turn = std::clamp(i - leg, 0, turning), before = std::max(leg - i, 0),
              behind = std::max(i - leg - turning, 0);
    const double angle = kPi * on_turn / turning;
    out.col(i) = Vec3(-radius * std::cos(angle), radius * std::sin(angle) - kEdge * (before + behind), 0.0);
  }
  return out;
}

/// Arclengths between the places that press on each other, ascending.
std::vector<double> pressing_loops(const Points& x) {
  Material material;
  material.radius = 1.0;
  const Eigen::Index edges = x.cols() - 1;
  SmoothContact contact(make_rod(material, (x.rightCols(edges) - x.leftCols(edges)).colwise().norm()), kNormal,
                        Friction(), kMargin);
  contact.begin(x);
  contact.evaluate(x, x, 1.0);
  std::vector<double> out;
  for (const ContactPoint& point : contact.contacts())
    if (point.force.norm() > 0.0) out.push_back(std::abs(point.arclength_b - point.arclength_a));
  std::sort(out.begin(), out.end());
  return out;
}

/// The nearest places that press lie on the legs' first edges.
TEST(SmoothContact, BeginsHalfATurnAlongTheRod) {
  EXPECT_TRUE(pressing_loops(hairpin(2.05)).empty());
  const std::vector<double> loops = pressing_loops(hairpin(1.98));
  ASSERT_FALSE(loops.empty());
  EXPECT_GE(loops.front(), kPi);
  EXPECT_LE(loops.front(), kPi + 2.0 * kEdge);
}

/// A strand along z that ends, and one along x that lies across it and slides towards its end and over it.
class SlidingOver {
 public:
  SlidingOver()
      : strands_(straight_strand(Vec3(-3.0, 1.99, 0.0), Vec3::UnitX(), std::vector(30, kEdge)),
                 straight_strand(Vec3(0.0, 0.0, -20.0), Vec3::UnitZ(), std::vector(100, kEdge))),
        contact_(strands_.rod, kNormal, Friction(), kMargin) {}

  /// Force of the points of the crossing strand on their feet, once it rests with so much of the other one's spline
  /// beyond it. That strand's own points press on their feet as before.
  double force_with_left(double left) {
    const double end = -0.5 * kEdge;  // of the spline: the middle of the last edge
    Points position = strands_.position;
    position.leftCols(strands_.second - 1).row(2).array() += end - left;
    for (int step = 0; step < 2; ++step) {  // the second one begins with what the first one leaves
      contact_.begin(position);
      contact_.evaluate(position, position, 1e3);
      contact_.commit(position);
    }
    double out = 0.0;
    for (const ContactPoint& point : contact_.contacts())
      if (point.b0 >= strands_.second - 1) out += point.force.y();
    return out;
  }

 private:
  TwoStrandsOfARod strands_;
  SmoothContact contact_;
};

TEST(SmoothContact, LosesItsForceBeforeAStrandSlipsOverAnEnd) {
  SlidingOver over;
  const double whole = over.force_with_left(2.0);
  ASSERT_GT(whole, 0.0);
  double before = whole;
  for (const double left : {0.1, 0.05, 0.02, 1e-3, 1e-6}) {
    const double now = over.force_with_left(left);
    EXPECT_LT(now, before) << left;
    before = now;
  }
  EXPECT_LT(before, 1e-5 * whole);
  EXPECT_EQ(over.force_with_left(-1e-6), 0.0);
}

constexpr double kStep = 0.01, kCatchUp = 0.05;

SmoothContact contact_of(const RodProperties& rod) { return {rod, NormalLaw{1.0, 0.01}, Friction(), 0.5, kCatchUp}; }

void evaluate(SmoothContact& contact, const Points& position, const Points& start) {
  contact.begin(start);
  contact.evaluate(position, start, kStep);
}

TEST(IntegrationPoints, StandForTheVoronoiLengthOfTheirSegment) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> length(0.1, 0.5);
  std::vector<double> edges(40);
  for (double& edge : edges) edge = length(random);
  const Points one = straight_strand(Vec3::Zero(), Vec3::UnitZ(), edges);
  const TwoStrandsOfARod strands(one, straight_strand(Vec3(1.9, 0.0, -3.0), Vec3::UnitZ(), std::vector(60, 0.65)));
  SmoothContact contact = contact_of(strands.rod);
  evaluate(contact, strands.position, strands.position);
  for (int segment = 1; segment + 1 < static_cast<int>(edges.size()); ++segment) {
    const double voronoi = strands.rod.voronoi_length[segment];
    const std::vector<ContactPoint> points = on_segment(contact.contacts(), segment);
    ASSERT_EQ(points.size(), 2U) << voronoi;
    double weight = 0.0, place = 0.0;
    for (const ContactPoint& point : points) {
      EXPECT_NEAR(point.overlap, 0.1, 1e-12);
      weight += point.weight / point.weighting;
      place += point.arclength_a / static_cast<double>(points.size());
    }
    EXPECT_NEAR(weight, voronoi, 1e-12);
    const Eigen::VectorXd arclength = strands.rod.arclength();
    EXPECT_NEAR(place, 0.25 * arclength[segment - 1] + 0.5 * arclength[segment] + 0.25 * arclength[segment + 1], 1e-12);
  }
}

/// What a strand wound around a straight one at a diameter's distance is out by, with so many edges a turn. Chords of
/// the ring are the rod's own length: it stands for a ring of just that circumference.
struct Wound {
  double overlap;  ///< error of it [radii]
  double force;    ///< by which the pressure on the inner strand is not that of the tension, relatively
  std::size_t points = 0;

  explicit Wound(int edges_a_turn) {
    const double angle = 2.0 * M_PI / edges_a_turn, arc_radius = 1.9, edge = arc_radius * angle;
    const double node_radius = 0.5 * edge / std::sin(0.5 * angle);
    constexpr int kNodes = 7, kMiddle = 3;
    Points ring(3, kNodes);
    for (int i = 0; i < kNodes; ++i) {
      const double at = angle * (i - kMiddle);
      ring.col(i) << node_radius * std::cos(at), node_radius * std::sin(at), 0.0;
    }
    const Points inner = straight_strand(Vec3(0.0, 0.0, -4.6), Vec3::UnitZ(), std::vector(16, 0.6));
    const TwoStrandsOfARod strands(ring, inner);
    SmoothContact contact = contact_of(strands.rod);
    evaluate(contact, strands.position, strands.position);

    // The middle node is pressed outwards through the points of three segments. Were they to carry all of their
    // contacts and no share of them, that would be what the tension T of its two edges balances, 2 T sin(angle/2).
    double on_node = 0.0, on_segment_itself = 0.0;
    for (int segment = kMiddle - 1; segment <= kMiddle + 1; ++segment)
      for (const ContactPoint& point : on_segment(contact.contacts(), segment)) {
        const Vec3 whole = point.force / point.weighting;
        on_node += point.c[kMiddle - point.a0] * whole.x();
        if (segment != kMiddle) continue;
        on_segment_itself += whole.norm();
        ++points;
        overlap = point.overlap - (2.0 - arc_radius);
      }
    const double tension = 0.5 * on_node / std::sin(0.5 * angle);
    force = on_segment_itself / (tension * angle) - 1.0;
  }
};

struct EdgesATurn {
  int coarse, fine;
};

class WoundStrand : public testing::TestWithParam<EdgesATurn> {};

TEST_P(WoundStrand, PressesAndStandsTrueToFourthOrder) {
  const EdgesATurn edges = GetParam();
  const Wound coarse(edges.coarse), fine(edges.fine);
  ASSERT_EQ(coarse.points, 2U);
  ASSERT_EQ(fine.points, 2U);
  const double ratio = static_cast<double>(edges.fine) / edges.coarse;
  auto order = [&](double from, double to) { return std::log(std::abs(from / to)) / std::log(ratio); };
  // Between 2 and 4, as edges of half a radian have errors of sixth order, too.
  EXPECT_GT(order(coarse.overlap, fine.overlap), 3.5);
  EXPECT_GT(order(coarse.force, fine.force), 3.5);
}

INSTANTIATE_TEST_SUITE_P(
    Edges, WoundStrand, testing::Values(EdgesATurn{11, 16}, EdgesATurn{18, 25}, EdgesATurn{40, 56}, EdgesATurn{40, 80}),
    [](const auto& edges) {
      return std::to_string(edges.param.coarse) + "And" + std::to_string(edges.param.fine) + "ATurn";
    });

/// A straight strand across an arc of radius 6, outside of it or within.
struct OnAnArc {
  static constexpr double kArc = 6.0, kOverlap = 0.05;
  static constexpr int kHalf = 7;     // edges of the arc to either side
  static constexpr int kAcross = 28;  // the straight strand's segment whose first point stands on the arc
  double angle;
  TwoStrandsOfARod strands;

  /// `shift`: by which part of an edge the straight strand stands beside the arc's middle node.
  OnAnArc(double edge, double shift, bool outside)
      : angle(edge / kArc), strands(arc(edge / kArc, shift), straight(outside)) {}

  static Points arc(double angle, double shift) {
    const double node_radius = 0.5 * kArc * angle / std::sin(0.5 * angle);
    Points out(3, 2 * kHalf + 1);
    for (int i = -kHalf; i <= kHalf; ++i)
      out.col(i + kHalf) << node_radius * std::cos(angle * (i + shift)), node_radius * std::sin(angle * (i + shift)),
          0.0;
    return out;
  }
  static Points straight(bool outside) {
    const double x = outside ? kArc + 2.0 - kOverlap : kArc - 2.0 + kOverlap;
    constexpr double kAcrossEdge = 0.25;
    return straight_strand(Vec3(x, 0.0, kAcrossEdge * (0.5 - kIntegrationPoints[0] - kAcross)), Vec3::UnitZ(),
                           std::vector(2 * kAcross, kAcrossEdge));
  }

  ContactPoint point(const SmoothContact& contact) const {
    const std::vector<ContactPoint> points = on_segment(contact.contacts(), strands.second + kAcross);
    EXPECT_EQ(points.size(), 2U);
    return points.empty() ? ContactPoint() : points.front();
  }
};

/// The largest of the error of the overlap wherever the straight strand stands between two nodes of the arc.
double error_on_arc(double edge, bool outside) {
  double worst = 0.0;
  for (const double shift : {0.0, 0.125, 0.25, 0.4, 0.5}) {
    const OnAnArc scene(edge, shift, outside);
    SmoothContact contact = contact_of(scene.strands.rod);
    evaluate(contact, scene.strands.position, scene.strands.position);
    worst = std::max(worst, std::abs(scene.point(contact).overlap - OnAnArc::kOverlap));
  }
  return worst;
}

class FootOnAnArc : public testing::TestWithParam<bool> {};

TEST_P(FootOnAnArc, StandsAtItsOwnDistanceToFourthOrder) {
  const double coarse = error_on_arc(1.6, GetParam()), middle = error_on_arc(0.8, GetParam()),
               fine = error_on_arc(0.4, GetParam());
  // The spline itself lies 1.6^2/(12 6) = 0.036 inside of the arc.
  EXPECT_LT(coarse, 0.1 * 0.036);
  EXPECT_LT(middle, coarse / 13.0);
  EXPECT_LT(fine, middle / 13.0);
}

INSTANTIATE_TEST_SUITE_P(Sides, FootOnAnArc, testing::Bool(),
                         [](const auto& side) { return side.param ? "Outside" : "Within"; });

/// By how far the foot stands outwards of the spline, towards its point.
double outwards(const ContactPoint& point) { return point.overlap - (2.0 - point.d); }

TEST(FootOfABendingStrand, StaysWithinAStepAndFollowsTheAcceptedShapeLikeTheShares) {
  // An arc as long as a straight rod was when the step began; the straight strand across it is carried along.
  const OnAnArc bent(1.2, 0.0, true);
  Points straight = bent.strands.position;
  for (int i = -OnAnArc::kHalf; i <= OnAnArc::kHalf; ++i) straight.col(i + OnAnArc::kHalf) << 6.0, 1.2 * i, 0.0;
  SmoothContact contact = contact_of(bent.strands.rod);
  evaluate(contact, straight, straight);
  EXPECT_NEAR(outwards(bent.point(contact)), 0.0, 1e-12);
  contact.commit(straight);

  SmoothContact elsewhere = contact_of(bent.strands.rod);
  evaluate(elsewhere, bent.strands.position, bent.strands.position);
  const double whole = outwards(bent.point(elsewhere));
  ASSERT_GT(whole, 0.01);

  evaluate(contact, bent.strands.position, straight);
  EXPECT_NEAR(outwards(bent.point(contact)), 0.0, 1e-12) << "in a step it stays where it was when that began";
  double expected = 0.0;
  for (int step = 0; step < 3; ++step) {
    contact.commit(bent.strands.position);
    evaluate(contact, bent.strands.position, bent.strands.position);
    expected += kStep / (kStep + kCatchUp) * (whole - expected);
    EXPECT_NEAR(outwards(bent.point(contact)), expected, 1e-9) << step;
  }
}

TEST(SampledCentreline, LiesOnTheCircleThatHasTheRodsOwnLengthToFourthOrder) {
  for (const int edges : {20, 40}) {
    Points nodes(3, edges + 1);
    for (int i = 0; i <= edges; ++i)
      nodes.col(i) = Vec3(std::cos(2.0 * M_PI * i / edges), std::sin(2.0 * M_PI * i / edges), 0.0);
    const Points places = sampled_centreline(nodes);
    ASSERT_EQ(places.cols(), 2 * (edges - 1));
    const double edge = 2.0 * std::sin(M_PI / edges);
    const double radius = edges * edge / (2.0 * M_PI);
    for (Eigen::Index i = 0; i < places.cols(); ++i) EXPECT_NEAR(places.col(i).norm(), radius, std::pow(edge, 4));
  }
}

constexpr double kRadius = 3e-3;
constexpr ContactLinearisation expecting{Linearisation::kTangent, true};

/// Two crossed strands that a prediction has drawn apart, where the last step had them pressed together.
ContactPoint drawn_apart() {
  ContactPoint out;
  out.c[1] = 1.0;
  out.c[4] = -1.0;
  out.n = Vec3::UnitZ();
  out.d = 2.011 * kRadius;
  out.x = out.d * out.n;
  out.overlap = 2.0 * kRadius - out.d;
  out.weight = kRadius;
  out.db = kRadius * Vec3::UnitX();
  out.inverse_g = 1.0 / out.db.squaredNorm();
  out.slip = 1e-6 * Vec3::UnitY();
  return out;
}

TEST(ContactModel, FrictionOfADrawnApartContactThatIsExpectedToPressHoldsIt) {
  const NormalLaw normal{1e6, 0.02 * kRadius};
  const MemoryFriction friction{0.5, 1e-5};
  const ContactLaws laws(normal, friction);
  std::vector<ContactPoint> contacts = {drawn_apart()};
  ContactPoint& contact = contacts[0];
  contact.prediction = 100.0;
  evaluate_forces(laws, kStep, contacts);
  EXPECT_EQ(contact.pressure, 0.0);
  std::vector<ContactModel> models;
  linearise(laws, kStep, expecting, contacts, models);
  EXPECT_LT(models[0].pressure, 0.0) << "the tangent at the prediction, so far out";
  // Across both strands: what holds is mu w p/xi_s, what turns with n is w p/d.
  const Vec3 across = to_vec3(models[0].still[1]);
  const double hold = friction.coefficient * contact.weight * contact.prediction / friction.presliding;
  EXPECT_NEAR(across.y(), hold, 0.02 * hold);
  linearise(laws, kStep, {}, contacts, models);
  EXPECT_LT(models[0].still[1][1], 0.0) << "the tangent's pressure drives it on";
}

TEST(ContactModel, EachContactHasItsOwnHoweverManyThereAre) {
  const NormalLaw normal{1e6, 0.02 * kRadius, 0.05 * kRadius};
  ContactLaws laws(normal, MemoryFriction{0.5, 1e-5});
  laws.of[1] = {NormalLaw{2e6, 0.02 * kRadius, 0.05 * kRadius}, MemoryFriction{0.3, 1e-5}};
  laws.of[2] = {NormalLaw{4e6, 0.02 * kRadius, 0.05 * kRadius}, MemoryFriction{0.1, 2e-5}};
  std::vector<ContactPoint> many;
  for (int i = 0; i < 11; ++i) {
    ContactPoint& contact = many.emplace_back(drawn_apart());
    contact.d -= 1e-3 * kRadius * (4 * i - 5);  // some are apart and take no part
    contact.x = contact.d * contact.n;
    contact.overlap = 2.0 * kRadius - contact.d;
    contact.begins = normal.begin();
    contact.pair = i / 2 % 3;
    contact.slip *= i;  // some stick, some slip
    contact.turn = 1e-7 * i * Vec3::UnitX();
    if (i % 3 == 0) contact.prediction = 10.0 * (i - 1);
  }
  std::vector<ContactModel> models;
  evaluate_forces(laws, kStep, many);
  linearise(laws, kStep, expecting, many, models);
  std::size_t n = 0;
  for (const ContactPoint& contact : many) {
    if (!contact.active()) continue;
    std::vector<ContactPoint> alone = {contact};
    std::vector<ContactModel> own;
    evaluate_forces(laws, kStep, alone);
    linearise(laws, kStep, expecting, alone, own);
    EXPECT_EQ(alone[0].force, contact.force);
    const PairLaws& pair = laws[contact.pair];
    EXPECT_EQ(contact.pressure, pair.normal.pressure(contact.overlap));
    EXPECT_LE(contact.mu, pair.friction.coefficient());
    // The overlap of an prediction is found to 1e-9 of the pressure, or better beside one that takes longer.
    const double rounding = 1e-8 * (own[0].slope * kRadius + std::abs(own[0].pressure));
    EXPECT_NEAR(own[0].pressure, models[n].pressure, rounding);
    EXPECT_NEAR(own[0].slope, models[n].slope, rounding / kRadius);
    EXPECT_NEAR((to_vec3(own[0].force) - to_vec3(models[n].force)).norm(), 0.0, contact.weight * rounding);
    EXPECT_NEAR((to_vec3(own[0].slide) - to_vec3(models[n].slide)).norm(), 0.0, 1e-8 * to_vec3(own[0].slide).norm());
    const Mat3 still = still_of(own[0]);
    EXPECT_NEAR((still - still_of(models[n])).norm(), 0.0, 1e-8 * still.norm());
    ++n;
  }
  EXPECT_GT(n, 4u);
  EXPECT_LT(n, many.size());
}

}  // namespace
}  // namespace knot_utm
