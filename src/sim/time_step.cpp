#include "knot_utm/sim/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "diagnose_step.hpp"
#include "examine_step.hpp"
#include "knot_utm/contact/edge_contact.hpp"
#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/contact/strand_passage.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/rod/bending.hpp"
#include "knot_utm/rod/energy.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/stretching.hpp"
#include "knot_utm/sim/centreline_terms.hpp"
#include "knot_utm/sim/frame_terms.hpp"
#include "knot_utm/sim/roller_turns.hpp"
#include "knot_utm/sim/step_matrix.hpp"
#include "residual_rule.hpp"

namespace knot_utm {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The largest residual, and whose it is.
struct Worst {
  double residual = 0.0;  // over the node's ease [N]
  int node = -1;          // none: all are held
  bool spin = false;      // the torque on the edge behind the node, over the radius
};

/// Of the linear model of a contact.
struct LinearPressure {
  double pressure, slope;  // at the present overlap [N/m], and by it [N/m^2]
};

constexpr int kTurns = 3;                // of secants and tangents
constexpr double kShareBySecants = 0.5;  // of a change

template <typename StrandContact>
StrandContact strand_contact(const RodProperties& rod, const StepSettings& settings) {
  if constexpr (std::is_same_v<StrandContact, SmoothContact>)
    return SmoothContact(rod, settings.normal, settings.friction, settings.candidate_margin, settings.share_time);
  else
    return StrandContact(rod, settings.normal, settings.friction, settings.candidate_margin);
}

/// Stands for FrameTerms where the scene does not solve for twist.
struct NoFrames {
  NoFrames(const RodProperties&, const StepSettings&) {}
};

/// D = 3: the unknowns of node i are x_i. D = 4: they are x_i and the spin of edge i (FrameTerms); that of the last
/// node stands for nothing and is held.
/// `StrandContact` is the contact law between strands.
template <int D, typename StrandContact>
class ImplicitStep final : public TimeStep {
 public:
  ImplicitStep(const RodProperties& rod, const RodState& state, const StepSettings& settings)
      : TimeStep(rod, state, settings),
        contact_(strand_contact<StrandContact>(rod, settings)),
        rollers_(rod, settings.normal, settings.roller_friction, settings.motion_limit),
        passage_(rod.nodes(), std::is_same_v<StrandContact, SmoothContact>),
        centreline_(rod_, rod.natural_curvature.cols() == 0),
        frames_(rod_, settings_),
        rule_(settings_),
        nodes_(static_cast<int>(rod.nodes())),
        matrix_(nodes_),
        diagonal_(at(nodes_)),
        force_(at(nodes_)),
        change_(at(nodes_)),
        held_(at(nodes_), 0),
        readings_(rod_, state_, settings_, initial_spin_energy()),
        way_(3, nodes_) {
    if constexpr (D == 4)
      if (settings.friction_couple > 0.0) {
        if (settings.friction.on()) contact_.act_at_surface(settings.friction_couple, frames_.turns());
        if (settings.roller_friction.on()) rollers_.act_at_surface(settings.friction_couple, frames_.turns());
      }
  }

  StepSummary step(const Boundary& boundary, double dt, Solution solution) override {
    boundary_ = &boundary;
    dt_ = dt;
    StepSummary summary;
    summary.newton = solution == Solution::kSecants ? by_secants() : by_tangents(solution == Solution::kHastyTangents);
    if (!summary.newton.converged()) {
      summary.reason = summary.newton.reason();
      summary.diagnosis = diagnosis(worst_.node, worst_.residual);
      return summary;
    }
    const SolvedStep step = solved();
    examine(rod_, settings_, step, {contact_.contacts(), rollers_.contacts()}, passage_, summary);
    if (summary.accepted())
      commit(step);
    else
      summary.diagnosis = of_the_fastest_node();
    return summary;
  }

  void begin() {
    share_ = motion_ = 0.0;
    centreline_.take_present_tensions();
    how_.expects = false;
    linearise_by(how_);
    contact_.refresh(state_.position);
    predict();
    contact_.begin_step();
    rollers_.begin_step();
    if constexpr (D == 4) frames_.begin_step(state_, boundary_->fixed_twists, dt_);
    matrix_.begin_step();
  }

  NewtonSummary by_tangents(bool hasty) {
    begin();
    use(Linearisation::kTangent);
    if (hasty) expect();
    return newton(*this, {settings_.max_iterations, 1.0, hasty});
  }

  /// Secants creep up to the solution from afar, on a side of every kink; tangents from there find it in few
  /// iterations. Where whole changes leap to and fro, halves need not.
  NewtonSummary by_secants() {
    begin();
    NewtonSummary out = by_turns(1.0, 1);
    if (out.converged()) return out;
    begin();
    const int before = out.iterations;
    out = by_turns(kShareBySecants, kTurns);
    out.iterations += before;
    return out;
  }

  /// Secants, of whose changes that share is taken, and tangents, so many times over.
  NewtonSummary by_turns(double share, int turns) {
    NewtonSummary out;
    for (int turn = 0; turn < 2 * turns; ++turn) {
      const bool secants = turn % 2 == 0;
      const int before = out.iterations;
      use(secants ? Linearisation::kSecant : Linearisation::kTangent);
      out = newton(*this, {settings_.max_iterations, secants ? share : 1.0});
      out.iterations += before;
      if (out.end != NewtonSummary::End::kIterationLimit) break;
    }
    return out;
  }

  void expect() {
    centreline_.expect(state_.position);
    how_.expects = true;
    linearise_by(how_);
  }

  void use(Linearisation of_friction) {
    how_.friction = of_friction;
    linearise_by(how_);
  }

  void linearise_by(const ContactLinearisation& how) {
    contact_.linearise_by(how);
    rollers_.linearise_by(how);
  }

  // ---- the system that Newton solves -----------------------------------------------------------------------------

  double residual() {
    std::fill(force_.begin(), force_.end(), Lanes{0.0, 0.0, 0.0, 0.0});
    add_inertia_gravity_and_drag();
    centreline_.add_forces(x_, force_);
    if constexpr (D == 4) frames_.add_forces(x_, force_);
    contact_.evaluate(x_, state_.position, dt_);
    rollers_.evaluate(boundary_->rollers, x_, state_.position, dt_);
    add_contact_forces(contact_);
    add_contact_forces(rollers_);
    add_grips_and_forces();
    worst_ = worst();
    if (watcher_) report();
    return worst_.residual;
  }

  double tolerance() const {
    const double held_back = boundary_->extra_drag * dt_ * rod_.voronoi_length[1] / rod_.mass[1];
    return rule_.tolerance(centreline_.largest_tension(), dt_, held_back);
  }

  bool solve() {
    roller_turns_.begin(boundary_->rollers, rollers_, nodes_, dt_);
    matrix_.locate(contact_.contacts());
    matrix_.set_zero_beyond_band();
    centreline_.set_stiffness(inertia_and_drag(), matrix_);
    if constexpr (D == 4) frames_.add_stiffness(matrix_);
    change_ = force_;
    linearise(contact_, models_, pressures_);
    linearise(rollers_, roller_models_, roller_pressures_);
    add_grip_stiffness();
    for (int node = 0; node < nodes_; ++node) hold(node);
    return roller_turns_.empty() ? matrix_.values().solve(change_) : roller_turns_.solve(matrix_.values(), change_);
  }

  void move(double wanted_share) {
    double longest2 = 0.0;
    for (const Lanes& change : change_) {
      const double size2 = change[0] * change[0] + change[1] * change[1] + change[2] * change[2];
      longest2 = std::max(longest2, size2);
    }
    const double longest = std::max(std::sqrt(longest2), roller_turns_.largest_motion());
    double share = wanted_share * (longest > settings_.newton_cap ? settings_.newton_cap / longest : 1.0);
    if constexpr (D == 4) {
      share = std::min(share, wanted_share * frames_.longest_share(change_));
      frames_.move(change_, share);
    }
    for (int i = 0; i < nodes_; ++i) x_.col(i) += share * to_vec3(change_[at(i)]);
    roller_turns_.move(rollers_, share);
    centreline_.expect(change_, share);
    share_ = share;
    motion_ = share * longest;
    estimate_pressures(contact_.contacts(), pressures_, share);
    estimate_pressures(rollers_.contacts(), roller_pressures_, share);
  }

  /// In the shortest steps the residual shrinks to a thousandth, and two sides of a trifling jump (a foot that has two
  /// places to be) may be as far apart as that: a change of 1e-7 h between them moves nothing.
  bool stands_still() const {
    constexpr double kStill = 1e-7;
    return share_ == 1.0 && motion_ <= kStill * rod_.material.radius && worst_.residual <= settings_.residual;
  }

  void part(int edge) override {
    parted_edge_ = edge;
    centreline_.part(edge);
    if constexpr (D == 4) frames_.part(edge);
    contact_.part(edge);
    rollers_.part(edge);
    passage_.part(edge);
  }

  // ---- readings ---------------------------------------------------------------------------------------------------

  Vec3 reaction(int node) const override { return readings_.reaction(node); }
  double reaction_torque(int edge) const override { return D == 4 ? readings_.reaction_torque(edge) : 0.0; }
  Vec3 roller_force(int roller) const override { return readings_.roller_force(roller); }
  Vec3 roller_moment(int roller) const override { return readings_.roller_moment(roller); }
  RollerTurn roller_turn(int roller) const override { return rollers_.turn(roller); }
  Energies energies() const override { return readings_.energies(); }
  ContactReading contact_reading() const override { return readings_.contact(); }
  StepWork work() const override { return readings_.work(); }
  LoadSum loads() const override { return readings_.loads(); }
  std::vector<ContactForce> contact_forces() const override {
    return knot_utm::contact_forces(contact_.contacts(), state_.position);
  }
  double normal_force_between(const NodeRange& a, const NodeRange& b) const override {
    return knot_utm::normal_force_between(contact_.contacts(), a, b);
  }
  double roller_normal_force(const NodeRange& piece) const override {
    return knot_utm::roller_normal_force(rollers_.contacts(), piece);
  }

  void state(Archive& archive) override {
    archive.section("STEP");
    archive.same("nodes", nodes_);
    TimeStep::state(archive);
    archive(contact_, rollers_, matrix_, readings_);
  }

 private:
  /// Everything moves on as it did; held nodes stand where they must.
  void predict() {
    x_ = state_.position + dt_ * state_.velocity;
    std::fill(held_.begin(), held_.end(), 0);
    for (const FixedNode& fixed : boundary_->fixed_nodes) {
      held_[at(fixed.node)] = 1;
      x_.col(fixed.node) = fixed.position;
    }
  }

  void add_inertia_gravity_and_drag() {
    const double over_dt = 1.0 / dt_;
    for (int i = 0; i < nodes_; ++i) {
      const Vec3 velocity = (x_.col(i) - state_.position.col(i)) * over_dt;
      const Vec3 acceleration = (velocity - state_.velocity.col(i)) * over_dt;
      const double drag = (settings_.drag + boundary_->extra_drag) * rod_.voronoi_length[i];
      force_[at(i)] += to_lanes(rod_.mass[i] * (settings_.gravity - acceleration) - drag * velocity);
    }
  }

  /// -d(inertia and drag)/dx of every node [N/m].
  const std::vector<double>& inertia_and_drag() {
    const double mass_share = 1.0 / (dt_ * dt_), drag_share = (settings_.drag + boundary_->extra_drag) / dt_;
    for (int i = 0; i < nodes_; ++i) diagonal_[at(i)] = mass_share * rod_.mass[i] + drag_share * rod_.voronoi_length[i];
    return diagonal_;
  }

  /// Adds the row `times` . (x_i - x_{i+1}) to blocks (i, i) and (i, i+1).
  static void add_to_row(int row, const Vec3& times, Block<D>& own, Block<D>& next) {
    for (int j = 0; j < 3; ++j) {
      own.at(row, j) += times[j];
      next.at(row, j) -= times[j];
    }
  }

  /// Rows of the unknowns that the boundary prescribes.
  void hold(int node) {
    if constexpr (D == 4) {
      const double free = held_[at(node)] ? 0.0 : 1.0, turns = frames_.held(node) ? 0.0 : 1.0;
      if (free == 1.0 && turns == 1.0) return;
      const Lanes keep = {free, free, free, turns};
      matrix_.values().set_identity_row(node, keep);
      change_[at(node)] *= keep;
      roller_turns_.hold(node, keep);
      // A held angle is one of no change: the spin is what transport alone makes.
      if (turns == 0.0 && node + 1 < nodes_)
        add_to_row(3, frames_.lean(node), matrix_.band(node, 0, 0), matrix_.band(node, 0, 1));
    } else {
      if (!held_[at(node)]) return;
      matrix_.values().set_identity_row(node);
      change_[at(node)] = Lanes{0.0, 0.0, 0.0, 0.0};
      roller_turns_.hold(node, Lanes{0.0, 0.0, 0.0, 0.0});
    }
  }

  template <typename Contacts>
  void add_contact_forces(const Contacts& contacts) {
    for (std::size_t i = 0; i < contacts.contacts().size(); ++i) {
      const ContactPoint& contact = contacts.contacts()[i];
      if (!contact.touches()) continue;
      add_contact_force(contact, to_lanes(contact.force), force_);
      if constexpr (D == 4)
        if (contacts.at_surface()) {
          const SurfacePoint& surface = contacts.surfaces()[i];
          add_couples(contact, surface, surface.on_a, surface.on_b, force_);
        }
    }
  }

  /// What the force g on a's side of a contact does to the nodes.
  static void add_contact_force(const ContactPoint& contact, const Lanes& g, std::vector<Lanes>& to) {
    for (int k = 0; k < 3; ++k) to[at(contact.a0 + k)] += contact.c[k] * g;
    if (!contact.on_roller())
      for (int k = 0; k < 3; ++k) to[at(contact.b0 + k)] += contact.c[3 + k] * g;
  }

  /// Replaces the contacts' forces in the right-hand side by those of their linear models, and adds their stiffness.
  template <typename Contacts, typename Model>
  void linearise(const Contacts& contacts, std::vector<Model>& models, std::vector<LinearPressure>& pressures) {
    constexpr bool kOnRollers = std::is_same_v<Contacts, RollerContact>;
    pressures.clear();
    if constexpr (D == 4)
      if (contacts.at_surface())
        return contacts.linearise_surfaces(dt_, [&](std::size_t i, const SurfaceModel& model) {
          const ContactPoint& contact = contacts.contacts()[i];
          const SurfacePoint& surface = contacts.surfaces()[i];
          add_contact_force(contact, model.force - to_lanes(contact.force), change_);
          add_couples(contact, surface, model.on_a - surface.on_a, model.on_b - surface.on_b, change_);
          matrix_.add(contact, surface, model, frames_.turns(), pressures.size());
          if constexpr (kOnRollers) roller_turns_.add(contact, surface, model, frames_.turns());
          pressures.push_back({model.pressure, model.slope});
        });
    contacts.linearise(dt_, models);
    for (std::size_t i = 0; i < contacts.contacts().size(); ++i) {
      const ContactPoint& contact = contacts.contacts()[i];
      if (!contact.active()) continue;
      const Model& model = models[pressures.size()];
      add_contact_force(contact, model.force - to_lanes(contact.force), change_);
      matrix_.add(contact, model, pressures.size());
      if constexpr (kOnRollers) roller_turns_.add(contact, model);
      pressures.push_back({model.pressure, model.slope});
    }
  }

  /// What the linear models say of each contact's pressure after the change.
  void estimate_pressures(std::vector<ContactPoint>& contacts, const std::vector<LinearPressure>& pressures,
                          double share) {
    std::size_t n = 0;
    for (ContactPoint& contact : contacts) {
      if (!contact.active()) continue;
      const LinearPressure& p = pressures[n++];
      Lanes moved = {};
      for (int k = 0; k < 3; ++k) {
        moved += contact.c[k] * change_[at(contact.a0 + k)];
        if (!contact.on_roller()) moved += contact.c[3 + k] * change_[at(contact.b0 + k)];
      }
      contact.estimate = p.pressure - share * p.slope * dot(to_lanes(contact.n), moved);
    }
  }

  void add_grips_and_forces() {
    for (const SlippingGrip& grip : boundary_->grips)
      force_[at(grip.node)] += to_lanes(grip.force(x_.col(grip.node)) * grip.direction);
    for (const SpringHold& hold : boundary_->holds) force_[at(hold.node)] += to_lanes(hold.force(x_.col(hold.node)));
    for (const NodeForce& force : boundary_->forces) force_[at(force.node)] += to_lanes(force.force);
  }

  void add_grip_stiffness() {
    for (const SlippingGrip& grip : boundary_->grips) {
      const double force = grip.force(x_.col(grip.node));
      if (force <= 0.0 || grip.slips(x_.col(grip.node))) continue;
      add(matrix_.band(grip.node, 0, 0), grip.direction * grip.direction.transpose(), grip.stiffness);
    }
    for (const SpringHold& hold : boundary_->holds) add(matrix_.band(hold.node, 0, 0), hold.stiffness, 1.0);
  }

  double ease(int node, double tolerance) const { return rule_.ease(centreline_.largest_tension_at(node), tolerance); }

  /// The first that is no number, else the largest.
  Worst worst() const {
    const double tolerance = this->tolerance();
    Worst out;
    double largest2 = 0.0;
    for (int i = 0; i < nodes_; ++i) {
      if (held_[at(i)]) continue;
      const Lanes& f = force_[at(i)];
      const double size2 = f[0] * f[0] + f[1] * f[1] + f[2] * f[2], ease = this->ease(i, tolerance);
      if (!std::isfinite(size2)) return {size2, i, false};
      const double eased2 = size2 / (ease * ease);
      if (out.node >= 0 && eased2 <= largest2) continue;
      largest2 = eased2;
      out.node = i;
    }
    out.residual = std::sqrt(largest2);
    if constexpr (D == 4)
      for (int i = 0; i + 1 < nodes_; ++i) {
        if (frames_.held(i)) continue;
        const double size = std::abs(force_[at(i)][3]) / rod_.material.radius;
        if (!std::isfinite(size)) return {size, i, true};
        if (size > out.residual) out = {size, i, true};
      }
    // Whose it is then stays the worst of the rod's.
    out.residual = std::max(out.residual, RollerTurns::largest_unbalanced(boundary_->rollers, rollers_, dt_));
    return out;
  }

  void report() const {
    Iterate out;
    out.residual = worst_.residual;
    out.tolerance = tolerance();
    out.node = worst_.node;
    out.spin = worst_.spin;
    out.share = share_;
    out.motion = motion_;
    report_contacts(contact_.contacts(), out);
    report_contacts(rollers_.contacts(), out);
    watcher_(out);
  }

  void report_contacts(const std::vector<ContactPoint>& contacts, Iterate& out) const {
    for (const ContactPoint& contact : contacts) {
      out.active += contact.active() ? 1 : 0;
      if (!contact.touches()) continue;
      ++out.touching;
      if (out.in_contact && contact.overlap <= out.overlap) continue;
      out.in_contact = true;
      out.overlap = contact.overlap;
      out.roller = contact.roller;
      out.arclengths[0] = contact.on_roller() ? rod_.arclength()[contact.a0 + 1] : contact.arclength_a;
      out.arclengths[1] = contact.arclength_b;
    }
  }

  StepDiagnosis of_the_fastest_node() {
    Eigen::Index node = 0;
    way_.colwise().squaredNorm().maxCoeff(&node);
    const int i = static_cast<int>(node);
    return diagnosis(i, held_[at(i)] ? 0.0 : to_vec3(force_[at(i)]).norm() / ease(i, tolerance()));
  }

  StepDiagnosis diagnosis(int node, double residual) {
    if (node < 0) return {};
    return diagnose(rod_, solved(), node, residual, {contact_.contacts(), rollers_.contacts()});
  }

  /// As its unknowns stand now.
  SolvedStep solved() {
    way_.noalias() = x_ - state_.position;
    return {state_, x_, way_, *boundary_, dt_, force_, held_};
  }

  void commit(const SolvedStep& step) {
    read(step);
    contact_.commit(x_);
    rollers_.commit(boundary_->rollers);
    matrix_.commit();
    state_.velocity = way_ / dt_;
    if constexpr (D == 4) frames_.commit(state_);
    state_.position = x_;
  }

  void read(const SolvedStep& step) {
    readings_.begin(step, rollers_);
    FrameTerms::Energy frames;
    if constexpr (D == 4) frames = frames_.energy(way_, force_);
    readings_.add_elastic(centreline_.energy(way_), frames);
    readings_.add_contacts(step, contact_);
    readings_.add_contacts(step, rollers_);
  }

  double initial_spin_energy() const {
    if constexpr (D == 4) return frames_.kinetic_energy(state_.twist_rate);
    return 0.0;
  }

  ContactLinearisation how_;
  StrandContact contact_;
  RollerContact rollers_;
  StrandPassage passage_;
  CentrelineTerms centreline_;
  std::conditional_t<D == 4, FrameTerms, NoFrames> frames_;
  ResidualRule rule_;
  int nodes_;
  StepMatrix<D> matrix_;
  std::vector<double> diagonal_;
  const Boundary* boundary_ = nullptr;
  double dt_ = 0.0;
  RollerTurns roller_turns_;
  double share_ = 0.0, motion_ = 0.0;  // of the last change; its largest movement [m]
  Points x_;
  std::vector<Lanes> force_, change_;
  Worst worst_;  // of force_
  std::vector<char> held_;
  StepReadings readings_;
  Points way_;  // of the step that is accepted or diagnosed [m]
  // Of the active contacts, in order.
  std::vector<typename StrandContact::Model> models_;
  std::vector<RollerModel> roller_models_;
  std::vector<LinearPressure> pressures_, roller_pressures_;
};

}  // namespace

Eigen::VectorXd TimeStep::tension() const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(rod_.edges());
  for (Eigen::Index i = 0; i < rod_.edges(); ++i)
    if (i != parted_edge_)
      out[i] = stretching_tension(rod_.material.stretching_stiffness, rod_.rest_length[i],
                                  state_.position.col(i + 1) - state_.position.col(i));
  return out;
}

void TimeStep::take_set(double share) {
  if (rod_.natural_curvature.cols() == 0)
    throw InvalidInput("rod", "straight at rest", "made with natural curvatures, be they zero, to take a set");
  const Points& x = state_.position;
  const auto edge = [&](Eigen::Index j) { return Vec3(x.col(j + 1) - x.col(j)); };
  const auto directors = [&](Eigen::Index j) {
    return material_directors(edge(j).normalized(), state_.reference_director.col(j), state_.twist[j]);
  };
  for (Eigen::Index i = 1; i <= rod_.natural_curvature.cols(); ++i)
    rod_.natural_curvature.col(i - 1) =
        share * material_curvature(edge(i - 1), edge(i), directors(i - 1), directors(i));
}

void TimeStep::state(Archive& archive) {
  archive(state_);
  if (rod_.natural_curvature.cols() > 0) archive(rod_.natural_curvature);
}

std::unique_ptr<TimeStep> TimeStep::make(const RodProperties& rod, const RodState& state,
                                         const StepSettings& settings) {
  elastic_energy(rod, state);  // throws where rod and state do not fit together
  const bool edges = settings.contact_law == ContactLaw::kEdge;
  if (state.twist.size() == 0) {
    if (edges) return std::make_unique<ImplicitStep<3, EdgeContact>>(rod, state, settings);
    return std::make_unique<ImplicitStep<3, SmoothContact>>(rod, state, settings);
  }
  if (edges) return std::make_unique<ImplicitStep<4, EdgeContact>>(rod, state, settings);
  return std::make_unique<ImplicitStep<4, SmoothContact>>(rod, state, settings);
}

}  // namespace knot_utm
