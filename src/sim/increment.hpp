#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "contact_term.hpp"
#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/centreline_terms.hpp"
#include "knot_utm/sim/frame_terms.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/sim/step_account.hpp"
#include "knot_utm/sim/step_matrix.hpp"
#include "motion_term.hpp"

namespace knot_utm {

/// The unknowns that the boundary prescribes: positions of fixed nodes, and angles of fixed material frames (known to
/// FrameTerms). Their rows in the linear system state that they do not change.
class HeldUnknowns {
 public:
  /// Nodes from `solved` on are images of others (StepMatrix::tie).
  HeldUnknowns(std::size_t nodes, int solved) : held_(nodes, 0), solved_(solved) {}

  /// Moves the held nodes of a prediction to their prescribed positions.
  void begin(const StepStart& start, Points& x) {
    std::fill(held_.begin(), held_.end(), 0);
    std::fill(held_.begin() + solved_, held_.end(), 1);
    for (const FixedNode& fixed : start.boundary.fixed_nodes) {
      held_[static_cast<std::size_t>(fixed.node)] = 1;
      x.col(fixed.node) = fixed.position;
    }
  }

  bool holds(int node) const { return held_[static_cast<std::size_t>(node)] != 0; }
  const std::vector<char>& nodes() const { return held_; }

  void prescribe(StepMatrix<3>& matrix, std::vector<Lanes>& right) const {
    for (int node = 0; node < count(); ++node) {
      if (!holds(node)) continue;
      matrix.values().set_identity_row(node);
      right[static_cast<std::size_t>(node)] = Lanes{0.0, 0.0, 0.0, 0.0};
    }
  }

  void prescribe(const FrameTerms& frames, StepMatrix<4>& matrix, std::vector<Lanes>& right) const {
    for (int node = 0; node < count(); ++node) {
      const double moves = holds(node) ? 0.0 : 1.0, spins = frames.held(node) ? 0.0 : 1.0;
      if (moves == 1.0 && spins == 1.0) continue;
      const Lanes keep = {moves, moves, moves, spins};
      matrix.values().set_identity_row(node, keep);
      right[static_cast<std::size_t>(node)] *= keep;
      // A held angle does not change, so the spin equals the rotation by parallel transport alone.
      if (spins == 0.0 && node + 1 < count())
        add_to_row(3, frames.lean(node), matrix.band(node, 0, 0), matrix.band(node, 0, 1));
    }
  }

 private:
  int count() const { return static_cast<int>(held_.size()); }

  /// Adds the row `times` . (x_i - x_{i+1}) to the blocks (i, i) and (i, i+1).
  static void add_to_row(int row, const Vec3& times, Block<4>& own, Block<4>& next) {
    for (int j = 0; j < 3; ++j) {
      own.at(row, j) += times[j];
      next.at(row, j) -= times[j];
    }
  }

  std::vector<char> held_;
  int solved_;
};

/// The largest residual of a trial, and its node: that of an edge is the node before it.
struct WorstResidual {
  double residual = 0.0;  ///< divided by the node's tolerance scaling; of an edge its torque over the radius [N]
  int node = -1;          ///< -1: none, because all nodes are held
};

/// The norm in which Newton's method measures a residual: its tolerance, and the scaling of the tolerance by the
/// tension at a node.
///
///   tolerance  max(s clamp(l T, r/100, r), r/1000), s = min(1, (dt/t_r)^2 (1 + c dt/m))
///   scaling    1 + a T_i / tolerance: factor by which the residual of node i may exceed the tolerance
///
/// Symbols: r residual [N], l residual_at_little_tension (0: r replaces the clamp), a residual_of_tension, t_r
/// residual_from_step [s]; T largest tension of the rod and T_i that of the edges of node i [N]; c drag and m mass per
/// length [kg/m].
///
/// The imbalance that is left in each step excites vibrations of the rod, more so the shorter the steps are, and
/// vibrations keep the steps short. The tolerance therefore falls with dt^2. The tension of a node's own edges is used
/// for the scaling, because a locked knot carries kilonewtons beside tails that a very small force moves. While a shape
/// settles, its drag reduces the effect of the imbalance by 1 + c dt/m, and s is larger by this factor.
class ResidualNorm {
 public:
  explicit ResidualNorm(const StepSettings& settings)
      : residual_(settings.residual),
        from_step_(settings.residual_from_step),
        of_tension_(settings.residual_of_tension),
        at_little_tension_(settings.residual_at_little_tension) {}

  /// `held_back`: c dt/m.
  double tolerance(double tension, double dt, double held_back) const {
    const double short2 = dt * dt * (1.0 + held_back), full2 = from_step_ * from_step_;
    const double part = short2 < full2 ? short2 / full2 : 1.0;
    return std::max(part * loose(tension), kInShortSteps * residual_);
  }
  double scaling(double tension_at_node, double tolerance) const {
    return 1.0 + of_tension_ * tension_at_node / tolerance;
  }

  /// The largest scaled residual of the nodes that are not held. A residual that is not finite is returned at once.
  template <typename Held>
  WorstResidual worst_of_nodes(const std::vector<Lanes>& force, const CentrelineTerms& centreline, double tolerance,
                               const Held& held) const {
    WorstResidual out;
    double largest2 = 0.0;
    for (int i = 0; i < static_cast<int>(force.size()); ++i) {
      if (held.holds(i)) continue;
      const Lanes& f = force[static_cast<std::size_t>(i)];
      const double size2 = f[0] * f[0] + f[1] * f[1] + f[2] * f[2];
      const double scaling = this->scaling(centreline.largest_tension_at(i), tolerance);
      if (!std::isfinite(size2)) return {size2, i};
      const double scaled2 = size2 / (scaling * scaling);
      if (out.node >= 0 && scaled2 <= largest2) continue;
      largest2 = scaled2;
      out.node = i;
    }
    out.residual = std::sqrt(largest2);
    return out;
  }

  /// The same for the torques, divided by `radius`, on edges whose frames are not held. Returns `worst` where none is
  /// larger.
  template <typename Frames>
  static WorstResidual worst_of_spins(const std::vector<Lanes>& force, const Frames& frames, double radius, int edges,
                                      WorstResidual worst) {
    for (int i = 0; i < edges; ++i) {
      if (frames.held(i)) continue;
      const double size = std::abs(force[static_cast<std::size_t>(i)][3]) / radius;
      if (!std::isfinite(size)) return {size, i};
      if (size > worst.residual) worst = {size, i};
    }
    return worst;
  }

 private:
  static constexpr double kInShortSteps = 1e-3, kAtLittleTension = 1e-2;  // lower bounds, as fractions of r

  double loose(double tension) const {
    if (at_little_tension_ <= 0.0) return residual_;
    return std::clamp(at_little_tension_ * tension, kAtLittleTension * residual_, residual_);
  }

  double residual_, from_step_, of_tension_, at_little_tension_;
};

/// Takes the place of FrameTerms where the scene does not solve for twist.
struct NoFrames : ForceTerm {
  NoFrames(const RodProperties&, const StepSettings&, const HalfTurn*) {}
  void add_forces(const StepStart&, const Points&, std::vector<Lanes>&) {}
  void add_stiffness(LinearSystem<3>&) const {}
  void account(const SolvedStep&, StepAccount&) const {}
  void write(const std::vector<double>&, RodState&) {}
  double largest_factor(const std::vector<Lanes>&) const { return 1.0; }
  void move(const std::vector<Lanes>&, double) {}
  double kinetic_energy(const Eigen::VectorXd&) const { return 0.0; }
};

/// All force terms of the equation, its linear system, and storage for its unknowns. D = 3: the unknowns of node i are
/// x_i. D = 4: they are x_i and the spin of edge i (FrameTerms). The last node has no edge after it, so its spin is
/// held.
template <int D>
struct Equation {
  using Frames = std::conditional_t<D == 4, FrameTerms, NoFrames>;

  Equation(const RodProperties& rod_, const RodState& state, const StepSettings& settings_)
      : Equation(rod_, rod_, nullptr, state, settings_) {}
  /// That of the first half of a `whole` rod which is its own `image` (HalfRod); `rod_` ends behind the half.
  Equation(const RodProperties& rod_, const RodProperties& whole, const HalfTurn* image_, const RodState& state,
           const StepSettings& settings_)
      : rod(rod_),
        image(image_),
        settings(settings_),
        motion(rod, settings),
        centreline(rod, !state.curved_at_rest()),
        frames(rod, settings, image),
        strands(SmoothContact(whole, settings.pressure_law, settings.friction, settings.candidate_margin,
                              settings.weighting_time)),
        rollers(RollerContact(whole, rod.material.is_soft() ? settings.pressure_law.on_rigid() : settings.pressure_law,
                              settings.roller_friction, settings.motion_limit)),
        held(static_cast<std::size_t>(rod.nodes()), image ? image->half() : static_cast<int>(rod.nodes())),
        norm(settings),
        matrix(static_cast<int>(rod.nodes()), image),
        force(static_cast<std::size_t>(rod.nodes())),
        change(force.size()),
        of_strands(static_cast<std::size_t>(whole.nodes())) {
    if (settings.others) {
      strands.contacts().tell_apart(settings.others->between, settings.others->own);
      rollers.contacts().tell_apart(settings.others->on_rollers);
    }
    if constexpr (D == 4)
      if (settings.friction_couple > 0.0) {
        RollingLaws rolling = settings.rolling;
        if (settings.others) {
          rolling.of[1] = settings.others->rolling_between;
          rolling.of[2] = settings.others->rolling_own;
        }
        const bool soft = rod.material.is_soft();
        if (soft || settings.friction.on() || (settings.others && strands_of_others_rub(*settings.others)))
          strands.contacts().act_at_surface(settings.friction_couple, frames.turns(), rolling);
        if (soft || settings.roller_friction.on() || (settings.others && settings.others->on_rollers.friction.on()))
          rollers.contacts().act_at_surface(settings.friction_couple, frames.turns(), rolling);
        if (soft) {
          strands.contacts().soften(whole.rest_length);
          rollers.contacts().soften(whole.rest_length);
        }
      }
  }

  /// Calls act(term) for every force term, in the order in which forces are added.
  template <typename Act>
  void for_each_term(const Act& act) {
    act(motion);
    act(centreline);
    act(frames);
    act(strands);
    act(rollers);
    act(grips);
  }

  const RodProperties& rod;
  const HalfTurn* image;  // null: this is the equation of a whole rod
  const StepSettings& settings;
  MotionTerm motion;
  CentrelineTerms centreline;
  Frames frames;
  ContactTerm<D, SmoothContact> strands;
  ContactTerm<D, RollerContact> rollers;
  GripTerm grips;
  HeldUnknowns held;
  ResidualNorm norm;
  StepMatrix<D> matrix;
  Points x;                          // trial positions [m]
  std::vector<Lanes> force, change;  // forces on the unknowns, and changes of the unknowns
  std::vector<Lanes> of_strands;     // what they exert on all nodes of a rod of which this is half, or how these move

 private:
  static bool strands_of_others_rub(const StepSettings::OtherLaws& others) {
    return others.between.friction.on() || others.own.friction.on();
  }
};

/// The equation of one time step while it is being solved: find x, and with D = 4 the spins of the edges, such that for
/// all unknowns that are not held
///
///   0 = f(x) = f_motion + f_elastic + f_twist + f_strands + f_rollers + f_grips        (time_step.hpp)
///
/// The constructor sets the unknowns to their prediction: all nodes continue with their velocities, and held nodes are
/// at their prescribed positions. Newton's method (newton.hpp) then calls `residual`, `solve` and `move`.
template <int D>
class Increment {
 public:
  /// `predicts`: whether the stiffness uses the tensions and pressures that the last linear solve predicted, and at
  /// first those at the beginning of the step. The solution is then reached in few iterations or, if the step is too
  /// long, is soon seen to be out of reach. Otherwise the stiffness uses the tensions of the trial positions.
  Increment(Equation<D>& equation, const StepStart& start, bool predicts)
      : eq_(equation), start_(start), predicts_(predicts) {
    eq_.for_each_term([&](auto& term) { term.begin(start, predicts); });
    eq_.matrix.begin();
    eq_.x = start.state.position + start.dt * start.state.velocity;
    if (start.middle_moves != start.dt * start.middle_velocity)
      eq_.x.colwise() += start.middle_moves - start.dt * start.middle_velocity;
    eq_.held.begin(start, eq_.x);
    if (eq_.image) eq_.image->mirror(eq_.x);
  }

  /// Computes f(x), and returns its norm [N].
  double residual() {
    std::fill(eq_.force.begin(), eq_.force.end(), Lanes{0.0, 0.0, 0.0, 0.0});
    eq_.for_each_term([this](auto& term) {
      fold(term, eq_.force, [&](std::vector<Lanes>& to) { term.add_forces(start_, eq_.x, to); });
    });
    worst_ = worst();
    return worst_.residual;
  }

  double tolerance() const {
    const double held_back = start_.boundary.extra_drag * start_.dt * eq_.rod.voronoi_length[1] / eq_.rod.mass[1];
    return eq_.norm.tolerance(eq_.centreline.largest_tension(), start_.dt, held_back);
  }

  /// Computes the change of the unknowns from -(df/dx) dx = f. False where the matrix is singular.
  bool solve(Linearisation of_friction) {
    eq_.matrix.locate(eq_.strands.points());
    eq_.matrix.set_zero_beyond_band();
    eq_.change = eq_.force;
    LinearSystem<D> system{start_, eq_.x, eq_.matrix, eq_.change, {of_friction, predicts_}, spins()};
    eq_.centreline.add_stiffness(system);  // overwrites its blocks, to which the others add
    eq_.for_each_term([&](auto& term) {
      if constexpr (!std::is_same_v<decltype(term), CentrelineTerms&>)
        fold(term, eq_.change, [&](std::vector<Lanes>& to) {
          LinearSystem<D> part{start_, eq_.x, eq_.matrix, to, system.how, system.spins};
          term.add_stiffness(part);
        });
    });
    if constexpr (D == 4)
      eq_.held.prescribe(eq_.frames, eq_.matrix, eq_.change);
    else
      eq_.held.prescribe(eq_.matrix, eq_.change);
    if (eq_.image) eq_.matrix.tie(eq_.change);
    return eq_.matrix.values().solve(eq_.change);
  }

  /// Moves the unknowns by `wanted` times the change, or by less: no node or angle moves further than the limit
  /// for one iteration.
  void move(double wanted) {
    double longest2 = 0.0;
    for (const Lanes& change : eq_.change) {
      const double size2 = change[0] * change[0] + change[1] * change[1] + change[2] * change[2];
      longest2 = std::max(longest2, size2);
    }
    const double longest = std::sqrt(longest2), cap = eq_.settings.newton_cap;
    factor_ = wanted * (longest > cap ? cap / longest : 1.0);
    factor_ = std::min(factor_, wanted * eq_.frames.largest_factor(eq_.change));
    eq_.frames.move(eq_.change, factor_);
    for (int i = 0; i < nodes(); ++i) eq_.x.col(i) += factor_ * to_vec3(eq_.change[static_cast<std::size_t>(i)]);
    if (eq_.image) {
      eq_.image->mirror(eq_.x);
      eq_.image->spread(eq_.change, eq_.of_strands);
    }
    eq_.for_each_term([this](auto& term) {
      term.predict(is_strands<decltype(term)> && eq_.image ? eq_.of_strands : eq_.change, factor_);
    });
    motion_ = factor_ * longest;
  }

  /// Whether the solution has settled although the residual is above the tolerance of a short step. In the shortest
  /// steps the tolerance falls to a thousandth. Where a contact's closest-point projection jumps between two places,
  /// the residuals on both sides may differ by as much as that. The solution counts as settled if a whole change moved
  /// nothing by more than 1e-7 h and the residual is within the tolerance of long steps.
  bool stands_still() const {
    constexpr double kStill = 1e-7;
    return factor_ == 1.0 && motion_ <= kStill * eq_.rod.thinnest() && worst_.residual <= eq_.settings.residual;
  }

  const WorstResidual& worst_residual() const { return worst_; }

 private:
  int nodes() const { return static_cast<int>(eq_.force.size()); }
  int edges() const { return eq_.image ? eq_.image->half() : nodes() - 1; }

  template <typename Term>
  static constexpr bool is_strands = std::is_same_v<Term, ContactTerm<D, SmoothContact>&>;

  /// Calls add(forces) of a term. What strands of a half exert on the other half is folded back.
  template <typename Term, typename Add>
  void fold(const Term&, std::vector<Lanes>& to, const Add& add) {
    if (!is_strands<Term&> || !eq_.image) return add(to);
    std::fill(eq_.of_strands.begin(), eq_.of_strands.end(), Lanes{});
    add(eq_.of_strands);
    eq_.image->fold(eq_.of_strands, to);
  }

  const SectionTurns* spins() const {
    if constexpr (D == 4)
      return &eq_.frames.turns();
    else
      return nullptr;
  }

  WorstResidual worst() const {
    WorstResidual out = eq_.norm.worst_of_nodes(eq_.force, eq_.centreline, tolerance(), eq_.held);
    if (!std::isfinite(out.residual)) return out;
    if constexpr (D == 4) out = ResidualNorm::worst_of_spins(eq_.force, eq_.frames, eq_.rod.thinnest(), edges(), out);
    return out;
  }

  Equation<D>& eq_;
  const StepStart start_;
  bool predicts_;
  WorstResidual worst_;
  double factor_ = 0.0;  // damping factor of the last change; 0: this is the prediction
  double motion_ = 0.0;  // largest motion of a node by the last change [m]
};

}  // namespace knot_utm
