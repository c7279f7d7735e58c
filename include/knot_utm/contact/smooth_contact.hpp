#pragma once

#include <vector>

#include "knot_utm/contact/candidates.hpp"
#include "knot_utm/contact/centreline_curve.hpp"
#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/contact/foot_search.hpp"
#include "knot_utm/contact/surface_contact.hpp"

namespace knot_utm {

/// Self-contact of the rod along its smooth centreline: each strand is integrated by the midpoint rule, with two points
/// on a segment. Each point presses on its feet, its closest-point projections
/// on the other strands. Points and feet stand outwards of the spline, where the arc of the rod's own length runs: the
/// points by their weights (PointWeights), the feet, which are searched on the spline, by what their overlap gains. A
/// pair of points is seen from both sides; the two sides share it by
///
///     omega = g_b^4 / (g_a^4 + g_b^4 + 1e-4),   g_b = 1 - x.b''/|b'|^2,   g_a = 1 + x.a''/|a'|^2,
///
/// so that the curved strand is integrated and the straighter one projected on: where a strand coils around another
/// at the distance of contact, the other one stands in its centre of curvature and has no foot on it.
/// g is linear between the middle of a segment, where it is its own, and its ends, where it is the smaller one of the
/// two segments that meet: a foot that is about to vanish has a weighting factor of zero by then.
/// omega, and how far the foot stands outwards, follow the shape within a set time: were they to follow at once, two
/// places of a tight knot could throw a contact to and fro in steps however short, a flutter that no step resolves.
/// They and the friction's memory belong to the last accepted step and are constant within a step: they are carried by
/// the point of integration and found again by the nearest arclength of the foot, iterate by iterate, each by one foot
/// only: a foot that is new starts without memory, with what its place gives it for both.
class SmoothContact {
 public:
  using Model = ContactModel;

  /// `catch_up`: time within which omega, and how far feet stand outwards, follow the shape [s].
  SmoothContact(const RodProperties& rod, const PressureLaws& normal, const Friction& friction, double margin,
                double catch_up = 0.05);

  /// Friction acts at the surfaces of the strands, whose sections pass on that fraction of its couple (SurfacePoint);
  /// `turns` are those of the positions that are evaluated, and must outlive this. At first it acts on the centrelines.
  void act_at_surface(double couple, const SectionTurns& turns) {
    lever_ = 0.5 * couple;
    turns_ = &turns;
  }
  bool at_surface() const { return turns_ != nullptr; }

  /// From now on the rod has parted at an edge.
  void part(int edge) { candidates_.part(edge); }

  /// Begins a step from `start`: candidates are looked for anew where something has moved far enough, and predictions
  /// of the pressures are those of the last accepted step.
  void begin(const Points& start);

  /// All contacts at `position` in a step of length dt from `start`.
  void evaluate(const Points& position, const Points& start, double dt);
  /// Of all feet within reach those that press, are expected to, did when the step began, or are about to.
  const std::vector<ContactPoint>& contacts() const { return contacts_; }
  std::vector<ContactPoint>& contacts() { return contacts_; }
  /// Where friction acts at the surface: one for each contact.
  const std::vector<SurfacePoint>& surfaces() const { return surfaces_; }

  /// The consistent linearisation of the active contacts, in order; some more may follow that mean nothing.
  void linearise(const ContactLinearisation& how, double dt, std::vector<ContactModel>& models) const {
    knot_utm::linearise(normal_, friction_, dt, how, contacts_, models);
  }
  /// Where friction acts at the surface, of the next few from number `from` on (linearise_surfaces).
  std::size_t linearise(const ContactLinearisation& how, double dt, std::size_t from, SurfaceModels& models) const {
    return knot_utm::linearise(normal_, friction_, dt, how, contacts_, surfaces_, from, models);
  }

  /// Of one of `contacts()`; the overlap but for the third order of the way of its foot.
  ContactMotion motion(const ContactPoint& contact, const Points& position, const Points& start) const;

  /// The evaluated state becomes the one that the next step remembers. `position` is what was last evaluated.
  void commit(const Points& position);

  /// e(D) of the pressure law [N]
  double energy(double overlap) const { return energy_of(normal_, overlap); }

  /// Of the last accepted step.
  void state(Archive& archive);

 private:
  /// What a foot carries from iteration to iteration, and from step to step.
  struct Memory {
    double arclength_b;
    double weighting;  // omega
    double outwards;   // of the spline stands the foot, towards its point [m]
    double pressure;   // prediction of it; < 0: none
    FrictionMemory friction;
    bool pressed = false;  // at the beginning of the step
    bool inside = false;   // was deep inside when it appeared, and has not come out yet

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
    std::size_t foot;     // number of it in search_
    std::size_t contact;  // number of it; kNone where it takes no part
  };
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// Of a point of integration as search_ numbers them.
  int segment_of(int point) const { return candidates_.segments()[static_cast<std::size_t>(point / 2)]; }
  std::size_t row_of(int point) const { return static_cast<std::size_t>(2 * segment_of(point) + point % 2); }

  /// Tracks this foot and the other ones of its point, but those too near along the rod; the first foot of the next.
  std::size_t follow(std::size_t foot);
  /// Gives the feet of a point, those tracked from `first` on, what the last iterate remembers of them.
  void recall(std::size_t row, std::size_t first);
  /// Of a foot and its point [m]
  double overlap(const Tracked& foot) const;
  /// Whether the foot and its point overlapped as the step began, and so did not come into each other in it.
  bool began_inside(const Tracked& foot) const;
  /// A foot takes part where it presses, is expected to or did when the step began, or is about to. Not so one that
  /// appears deep inside between places that overlapped as the step began: a bend as sharp as the strand is thick has
  /// closed around the point, as around the end of a tail, and would throw it out with what force the depth gives.
  bool takes_part(const Tracked& foot) const;
  void add_contact(Tracked& tracked);
  void set_slip(ContactPoint& contact) const;
  void add_surface(const ContactPoint& contact, const SegmentParabola& a, const SegmentParabola& b, double u_b);
  void remember(const Points* position, MemoryList& list) const;
  /// Of the accepted position, at first that of the start; where the rod is bent more sharply than its edges resolve,
  /// less and less.
  void put_outwards(const Points& position);
  double weighting(const FootSearch::Foot& foot, const Points& position) const;
  /// What the weighting factor of a foot cannot exceed: it falls to zero on the last radius before the spline ends,
  /// where a strand slips off. A force that vanished there all at once would leave steps, however short, without a
  /// solution.
  double largest_weighting(const Memory& memory) const;
  double outwards(const FootSearch::Foot& foot, const Points& position) const;

  PressureLaws normal_;
  double begins_;  // overlap at which it does [m]
  Friction friction_;
  double dt_ = 0.0;  // of this step [s]
  double diameter_;
  double window_;              // of arclength within which a foot is the same one [m]
  double reach_;               // of centrelines within which feet are followed [m]
  Eigen::VectorXd arclength_;  // of the nodes
  Eigen::VectorXd voronoi_;
  Eigen::VectorXd outwards_;  // fraction of the second difference by which a segment stands outwards; at first empty
  Candidates candidates_;
  FootSearch search_;
  std::vector<Tracked> tracked_;
  std::vector<ContactPoint> contacts_;
  double lever_ = 0.0;                   // lambda of SurfacePoint
  const SectionTurns* turns_ = nullptr;  // where friction acts at the surface
  std::vector<SurfacePoint> surfaces_;
  MemoryList accepted_;         // of the last accepted step
  std::vector<char> recalled_;  // of iterate_: given to a contact
  MemoryList iterate_;          // of the last evaluation; before the first of a step, the accepted ones
  std::vector<Lanes> moved_;    // by which the nodes moved in this step [m]
  double catch_up_time_;
  double catch_up_ = 1.0;  // by which weighting factors and feet follow in this step
  bool first_evaluation_ = true;
  bool first_step_ = true;  // none was accepted yet
};

}  // namespace knot_utm
