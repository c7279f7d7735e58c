#pragma once

#include <array>
#include <memory>
#include <vector>

#include "knot_utm/contact/candidates.hpp"
#include "knot_utm/contact/centreline_curve.hpp"
#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/contact/foot_search.hpp"
#include "knot_utm/contact/soft_section.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/half_turn.hpp"

namespace knot_utm {

/// Self-contact of the rod along its smooth centreline: each strand is integrated by the midpoint rule, with two points
/// on a segment. Each point presses on its feet, its closest-point projections
/// on the other strands. Points and feet lie outwards of the spline, where the arc of the rod's own length runs: points
/// by their weights (PointWeights), and feet, which are searched on the spline, by an addition o to the overlap. Each
/// contact is seen from both strands, which share it by the weighting factor
///
///     omega = g_b^4 / (g_a^4 + g_b^4 + 1e-4),   g_b = 1 - x.b''/|b'|^2,   g_a = 1 + x.a''/|a'|^2,
///
/// so that the integration runs along the curved strand and the projection goes onto the straighter one. Where a strand
/// coils around another at the distance of contact, the inner one lies in the centre of curvature of the outer one and
/// has no foot on it. g is interpolated linearly from the middle of a segment, where it is that of the segment, to its
/// ends, where it is the smaller one of the two segments that meet. A foot that is about to vanish thus has a weighting
/// factor of zero by then. omega and o relax towards the shape within a set time. If they followed at once, a contact
/// of a tight knot could alternate between two places from step to step, however short the steps are. omega, o and the
/// friction's memory belong to the last accepted step and are constant within a step. The integration point carries
/// them from iterate to iterate, and each is assigned to one foot, that of the nearest arclength. A new foot has no
/// memory; its omega and o are those of its place. But where friction acts at the surfaces, a foot that appears inside
/// the rod begins with omega = 0, which then relaxes, too: with a finite omega its force would come and go from iterate
/// to iterate, and no step would be short enough.
class SmoothContact {
 public:
  using Model = ContactModel;

  /// `catch_up`: relaxation time with which omega and o follow the shape [s].
  SmoothContact(const RodProperties& rod, const NormalLaw& normal, const Friction& friction, double margin,
                double catch_up = 0.05);

  /// From now on the ropes behind the first one, of another material, have these laws with it and among themselves.
  void tell_apart(const PairLaws& between, const PairLaws& others) {
    laws_.of[1] = between;
    laws_.of[2] = others;
  }

  /// From now on friction acts at the surfaces of the strands, whose sections transmit the fraction `couple` of its
  /// couple (SurfacePoint), and contacts resist rolling. Otherwise it acts on the centrelines. `turns` belong to the
  /// positions that are evaluated and must outlive this object.
  void act_at_surface(double couple, const SectionTurns& turns, const RollingLaws& rolling = {}) {
    couple_ = couple;
    rolling_ = rolling;
    turns_ = &turns;
  }
  bool at_surface() const { return turns_ != nullptr; }
  /// From now on sections give (SoftPoint), beside friction at the surfaces. The lengths of edges at rest must outlive
  /// this object, which reads them anew each time.
  void soften(const Eigen::VectorXd& rest_length) { rest_length_ = &rest_length; }
  bool soft() const { return rest_length_ != nullptr; }

  /// From now on the rod is cut at this edge, too.
  void part(int edge) { candidates_->part(edge); }

  /// From now on only points of integration on the half are evaluated (HalfTurn), on what `whole` left of the last
  /// accepted step.
  void halve(const SmoothContact& whole);
  /// Goes on with the step that `half` has solved: what its feet carry, and their images.
  void mirror(const SmoothContact& half, const HalfTurn& image);

  /// Begins a step from `start`: the search for candidates is repeated where a node has moved far enough, and the
  /// predicted pressures are those of the last accepted step.
  void begin(const Points& start);

  /// All contacts at `position` in a step of length dt from `start`.
  void evaluate(const Points& position, const Points& start, double dt);
  /// Those of the feet within reach that press, are predicted to, did so when the step began, or nearly touch.
  const std::vector<ContactPoint>& contacts() const { return contacts_; }
  std::vector<ContactPoint>& contacts() { return contacts_; }
  /// Where friction acts at the surface: one for each contact.
  const std::vector<SurfacePoint>& surfaces() const { return surfaces_; }
  /// Where sections give: one for each contact.
  const std::vector<SoftPoint>& soft_points() const { return soft_; }

  /// The consistent linearisation of the active contacts, in order; unused models may follow.
  void linearise(const ContactLinearisation& how, double dt, std::vector<ContactModel>& models) const {
    knot_utm::linearise(laws_, dt, how, contacts_, models);
  }
  /// The same where friction acts at the surface, for the next few contacts from number `from` on (linearise_surfaces).
  std::size_t linearise(const ContactLinearisation& how, double dt, std::size_t from, SurfaceModels& models) const {
    return knot_utm::linearise(laws_, rolling_, dt, how, contacts_, surfaces_, soft_, from, models);
  }

  /// The motion of one of `contacts()` in this step. The overlap at the beginning neglects the third order in the
  /// motion of the foot.
  ContactMotion motion(const ContactPoint& contact, const Points& position, const Points& start) const;

  /// The evaluated state becomes the one that the next step remembers. `position` is what was last evaluated.
  void commit(const Points& position);

  /// e(D) of the pressure law [N]
  double energy(int pair, double overlap) const { return laws_[pair].normal.energy(overlap); }

  /// Saves or loads what the last accepted step left.
  void state(Archive& archive);

 private:
  /// What a foot carries from iteration to iteration, and from step to step.
  struct Memory {
    double arclength_b = 0.0;
    double weighting = -1.0;  // omega; < 0: of a foot that recalls none yet
    double offset = 0.0;      // o: the strand of the foot lies this far outwards of its spline, towards the point [m]
    double pressure = -1.0;   // predicted; < 0: none
    FrictionMemory friction;
    Vec3 z = Vec3::Zero();  // of the last trial in this step; zero: there was none
    double zeta = 0.0;      // the same of the resistance to rolling
    bool pressed = false;   // at the beginning of the step
    bool inside = false;    // appeared deep inside and has not come out yet

    void state(Archive& archive);
  };
  /// Feet of every point of integration 2 segment + point, as compressed rows.
  struct MemoryList {
    std::vector<Memory> entries;
    std::vector<int> begin;

    void state(Archive& archive);
  };

  /// A foot within reach.
  struct Tracked {
    Memory memory;
    std::size_t foot = 0;         // number of it in search_
    std::size_t contact = kNone;  // number of it; kNone where it is left out
    int pair = 0;                 // of materials (ContactLaws)
    SoftPoint soft;
  };
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// Both integration points of a segment.
  using PointsOfSegment = std::array<Lanes, 2>;
  PointsOfSegment points_of(int segment) const;
  /// Finds all feet at `position`. Where friction acts at the surfaces, the feet of the last search in this step are
  /// followed instead if no node has moved far since.
  void find_feet(const Points& position, const std::vector<int>& segments);
  /// False where a foot is lost (FootSearch::follow).
  bool follow_feet(const Points& position, const std::vector<int>& segments);
  void mirror_feet(const SmoothContact& half, const HalfTurn& image);
  /// Whether no node has moved far since the last search.
  bool near_last_search() const;

  /// The segment of an integration point, which goes by its number in search_.
  int segment_of(int point) const { return candidates_->segments()[static_cast<std::size_t>(point / 2)]; }
  std::size_t row_of(int point) const { return static_cast<std::size_t>(2 * segment_of(point) + point % 2); }

  /// Tracks this foot and the others of its point, except those too near along the rod. Returns the first foot of the
  /// next point.
  std::size_t follow(std::size_t foot);
  /// Gives the feet of a point, which are tracked from `first` on, their memories from the last iterate.
  void recall(std::size_t row, std::size_t first);
  /// What thinning makes of a foot and its point, and how much longer than at rest the point's strand is.
  void set_soft(Tracked& foot) const;
  double stretch(int segment, double u) const;
  /// The overlap of a foot and its point [m]
  double overlap(const Tracked& foot) const;
  /// Whether the foot and its point already overlapped when the step began.
  bool began_inside(const Tracked& foot) const;
  /// A foot takes part where it presses, is predicted to, did so when the step began, or nearly touches. A foot that
  /// appears deep inside is left out if the two places already overlapped when the step began: a bend as sharp as the
  /// strand is thick has closed around the point, such as the end of a tail, and the force of that depth would throw it
  /// out.
  bool takes_part(const Tracked& foot) const;
  void add_contact(Tracked& tracked);
  void set_slip(ContactPoint& contact) const;
  void add_surface(const ContactPoint& contact, const SegmentParabola& a, const SegmentParabola& b, double u_b);
  void remember(const Points* position, MemoryList& list) const;
  FrictionMemory remembered(const ContactPoint& contact) const;
  /// Sets fraction_ for an accepted position, before the first step for its start. It falls to zero where the rod is
  /// bent more sharply than its edges resolve.
  void set_fractions(const Points& position);
  double weighting(const FootSearch::Foot& foot, const Points& position) const;
  /// Upper bound of a foot's weighting factor. It falls to zero towards the end of the spline, where a strand slips
  /// off, because a force that vanished there suddenly would leave steps, however short, without a solution.
  double largest_weighting(const Memory& memory) const;
  double offset_at(const FootSearch::Foot& foot, const Points& position) const;

  /// Whether a segment belongs to a rope of another material, as a number: 1 or 0.
  int is_other(int segment) const { return segment < first_of_other_ ? 0 : 1; }

  ContactLaws laws_;
  double dt_ = 0.0;            // of this step [s]
  int first_of_other_;         // node of the ropes of another material
  double radius_[2];           // of these materials [m]
  double distance_[3];         // of centrelines that touch, by pair [m]
  double diameter_;            // of the thinnest rope [m]
  double window_;              // of arclength within which a foot is the same one [m]
  double reach_;               // of centrelines within which feet are followed [m]
  Eigen::VectorXd arclength_;  // of the nodes
  Eigen::VectorXd voronoi_;
  Eigen::VectorXd fraction_;  // fraction of the second difference by which a segment stands outwards; at first empty
  std::size_t own_rows_;      // points of integration that are evaluated: rows before this one
  std::shared_ptr<Candidates> candidates_;  // the half's are those of the whole rod
  FootSearch search_;
  std::vector<Tracked> tracked_;
  std::vector<ContactPoint> contacts_;
  double couple_ = 0.0;                  // eta of SurfacePoint
  const SectionTurns* turns_ = nullptr;  // where friction acts at the surface
  std::vector<SurfacePoint> surfaces_;
  const Eigen::VectorXd* rest_length_ = nullptr;  // of edges, where sections give
  std::vector<SoftPoint> soft_;
  RollingLaws rolling_;
  MemoryList accepted_;          // of the last accepted step
  std::vector<char> recalled_;   // of each entry of iterate_: assigned to a foot
  MemoryList iterate_;           // of the last evaluation; before the first of a step, the accepted ones
  std::vector<Lanes> moved_;     // increments of the nodes in this step [m]
  std::vector<Lanes> searched_;  // the same at the last search; empty before the first one
  double catch_up_time_;
  double catch_up_ = 1.0;  // fraction by which omega and o relax in this step
  bool has_feet_ = false;  // those of the next evaluation are known
  bool first_evaluation_ = true;
  bool first_step_ = true;  // none was accepted yet
};

}  // namespace knot_utm
