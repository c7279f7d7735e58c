#include "knot_utm/sim/time_step.hpp"

#include "diagnose_step.hpp"
#include "half_rod.hpp"
#include "increment.hpp"
#include "knot_utm/contact/tunnelling.hpp"
#include "knot_utm/rod/bending.hpp"
#include "knot_utm/rod/energy.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

/// Solves the increment of a step in one of the ways of `SolveStrategy` (time_step.hpp).
///
/// Each of them makes its own `Increment`, so that all of them begin at the prediction.
template <int D>
class IncrementSolver {
 public:
  using TheEquation = Equation<D>;
  using TheIncrement = Increment<D>;

  IncrementSolver(TheEquation& equation, const StepStart& start) : equation_(equation), start_(start) {}

  /// Solves in the given way. The equation is left at the last trial, and `worst` is its largest residual.
  NewtonSummary solve(SolveStrategy strategy, WorstResidual& worst) {
    NewtonSummary out = strategy == SolveStrategy::kSecants
                            ? by_secants()
                            : by_tangents(strategy == SolveStrategy::kTangentsAbandonedEarly);
    worst = worst_;
    return out;
  }

 private:
  static constexpr int kTurns = 3;                 // largest number of rounds of secants and tangents
  static constexpr double kFactorOfSecants = 0.5;  // damping factor of the secants after the first round has failed

  /// The system that Newton's method solves: an increment with one linearisation of friction.
  struct System {
    TheIncrement& increment;
    Linearisation of_friction;

    double residual() { return increment.residual(); }
    double tolerance() const { return increment.tolerance(); }
    bool solve() { return increment.solve(of_friction); }
    void move(double factor) { increment.move(factor); }
    bool stands_still() const { return increment.stands_still(); }
  };

  NewtonSummary run(TheIncrement& increment, Linearisation of_friction, const NewtonOptions& options) {
    System system{increment, of_friction};
    NewtonSummary out = newton(system, options);
    worst_ = increment.worst_residual();
    return out;
  }

  NewtonSummary by_tangents(bool abandons_early) {
    TheIncrement increment(equation_, start_, abandons_early);
    return run(increment, Linearisation::kTangent, {equation_.settings.max_iterations, 1.0, abandons_early});
  }

  /// Secants approach the solution slowly from far away, but stay on one side of every kink of friction. From there
  /// tangents find it in few iterations. Where full changes make the iterates oscillate, halved ones may converge.
  NewtonSummary by_secants() {
    NewtonSummary out = by_turns(1.0, 1);
    if (out.converged()) return out;
    const int before = out.iterations;
    out = by_turns(kFactorOfSecants, kTurns);
    out.iterations += before;
    return out;
  }

  /// Up to `turns` rounds, each of secants with the damping factor `factor` and then of tangents.
  NewtonSummary by_turns(double factor, int turns) {
    TheIncrement increment(equation_, start_, false);
    NewtonSummary out;
    for (int turn = 0; turn < 2 * turns; ++turn) {
      const bool secants = turn % 2 == 0;
      const int before = out.iterations;
      out = run(increment, secants ? Linearisation::kSecant : Linearisation::kTangent,
                {equation_.settings.max_iterations, secants ? factor : 1.0});
      out.iterations += before;
      if (out.end != NewtonSummary::End::kIterationLimit) break;
    }
    return out;
  }

  TheEquation& equation_;
  const StepStart& start_;
  WorstResidual worst_;
};

namespace {

/// One step from its beginning to its end: the equation is solved (increment.hpp, IncrementSolver), what it would
/// do to the rod is examined, and only then does the state move on.
template <int D>
class ImplicitStep final : public TimeStep {
 public:
  ImplicitStep(const RodProperties& rod, const RodState& state, const StepSettings& settings)
      : TimeStep(rod, state, settings),
        equation_(rod_, state_, settings_),
        tunnelling_(rod.nodes(), true),
        readings_(rod_, state_, equation_.frames.kinetic_energy(state_.twist_rate), equation_.strands.points(),
                  equation_.rollers.contacts()),
        increment_(3, rod.nodes()) {
    for (const int edge : rod_.cuts) cut(edge);
    if (settings_.half_turn) half_.emplace(*settings_.half_turn, rod_, state_, settings_);
  }

  StepSummary step(const Boundary& boundary, double dt, SolveStrategy strategy) override {
    StepStart start{state_, boundary, dt};
    StepSummary summary;
    WorstResidual worst;
    if (half_) summary.newton = solve_half(start, strategy, worst);
    if (half_) summary.by_half = summary.newton.iterations;
    if (!half_) summary.newton = IncrementSolver<D>(equation_, start).solve(strategy, worst);
    Equation<D>& tried = half_ && !summary.newton.converged() ? half_->equation() : equation_;
    increment_.noalias() = tried.x - state_.position;
    const SolvedStep step{start, tried.x, increment_, tried.force, tried.held.nodes()};
    if (!summary.newton.converged()) {
      summary.reason = summary.newton.reason();
      if (worst.node >= 0) summary.diagnosis = diagnose(rod_, step, worst.node, worst.residual, contacts(tried));
      return summary;
    }
    examine(rod_, settings_, step, contacts(equation_), tunnelling_, summary);
    if (summary.accepted() && judge_) summary.reason = judge_(step.end, dt);
    if (summary.accepted())
      commit(step);
    else
      summary.diagnosis = diagnose_fastest_node(step, summary.newton.tolerance);
    return summary;
  }

  const StepReadings& readings() const override { return readings_; }
  void solve_whole() override { half_.reset(); }

  Vec3 tried_reaction(int node) const override { return -to_vec3(equation_.force[static_cast<std::size_t>(node)]); }
  Vec3 tried_roller_force(int roller) const override { return readings_.tried_roller_force(roller); }

  void state(Archive& archive) override {
    archive.section("STEP");
    archive.same("nodes", static_cast<int>(rod_.nodes()));
    TimeStep::state(archive);
    archive(equation_.strands.contacts(), equation_.rollers.contacts(), equation_.matrix, readings_);
    if (!archive.optional_section("HALF", half_.has_value())) return half_.reset();
    archive.require(half_.has_value(), "half of the rod", "one of a rod that has none");
    archive(*half_);
  }

 private:
  void take_lengths() override {
    equation_.for_each_term([](auto& term) { term.take_lengths(); });
    if (half_) half_->take_lengths(rod_);
  }

  void cut(int edge) {
    equation_.for_each_term([edge](auto& term) { term.part(edge); });
    tunnelling_.part(edge);
  }

  void commit(const SolvedStep& step) {
    account(step);
    equation_.for_each_term([&](auto& term) { term.commit(step); });
    equation_.matrix.commit();
    if (half_) half_->commit(step);
    state_.velocity = step.increment / step.dt;
    equation_.frames.write(equation_.centreline.tensions(), state_);
    state_.position = step.end;
  }

  void account(const SolvedStep& step) {
    StepAccount& account = readings_.begin(step);
    equation_.for_each_term([&](const auto& term) { term.account(step, account); });
    readings_.add_fall_of_elastic_energy();
  }

  StepDiagnosis diagnose_fastest_node(const SolvedStep& step, double tolerance) {
    Eigen::Index fastest = 0;
    step.increment.colwise().squaredNorm().maxCoeff(&fastest);
    const int node = static_cast<int>(fastest);
    const double scaling = equation_.norm.scaling(equation_.centreline.largest_tension_at(node), tolerance);
    const double residual =
        equation_.held.holds(node) ? 0.0 : to_vec3(step.force[static_cast<std::size_t>(node)]).norm() / scaling;
    return diagnose(rod_, step, node, residual, contacts(equation_));
  }

  static ContactLists contacts(const Equation<D>& of) { return {of.strands.points(), of.rollers.points()}; }

  /// Solves the step on the half of the rod, and places the image of its solution. Where the whole rod is then not as
  /// well solved, its state or something around it is not symmetric: from now on there is no half.
  NewtonSummary solve_half(StepStart& start, SolveStrategy strategy, WorstResidual& worst) {
    const StepStart of_half = half_->begin(start, equation_);
    const NewtonSummary out = IncrementSolver<D>(half_->equation(), of_half).solve(strategy, worst);
    if (!out.converged()) return out;
    Increment<D> whole(equation_, start, false);
    half_->place(equation_);
    equation_.held.begin(start, equation_.x);
    if (whole.residual() <= std::max(whole.tolerance(), kRounding * out.residual)) return out;
    half_.reset();
    start.middle_moves = start.middle_velocity = Vec3::Zero();
    return out;
  }

  static constexpr double kRounding = 1.01;  // residual of both halves over that of one, at most

  Equation<D> equation_;
  std::optional<HalfRod<D>> half_;  // while the rod is its own image under a half-turn
  TunnellingSearch tunnelling_;
  StepReadings readings_;
  Points increment_;  // of the step that is accepted or diagnosed [m]
};

}  // namespace

Eigen::VectorXd TimeStep::tension() const { return edge_tension(rod_, state_); }

void TimeStep::lay(const Eigen::VectorXd& rest_length, const Points& position) {
  const Points before = state_.position;
  state_.position = position;
  if (state_.twist.size() > 0) transport_frames(before, &state_);
  set_lengths(rest_length);
}

void TimeStep::set_lengths(const Eigen::VectorXd& rest_length) {
  const RodProperties laid = make_rod(rod_.material, rest_length);
  rod_.rest_length = laid.rest_length;
  rod_.voronoi_length = laid.voronoi_length;
  rod_.mass = laid.mass;
  take_lengths();
}

void TimeStep::state(Archive& archive) {
  Eigen::VectorXd lengths = rod_.rest_length;
  if (archive.optional_section("LAID", lengths != made_with_.rest_length)) {
    archive.list(lengths);
    const bool fits = lengths.size() == rod_.edges() && lengths.allFinite() && lengths.minCoeff() > 0.0;
    archive.require(fits, "lengths of the rod", "those of no rod");
    if (archive.loads()) set_lengths(lengths);
  }
  archive(state_);
}

std::unique_ptr<TimeStep> TimeStep::make(const RodProperties& rod, const RodState& state,
                                         const StepSettings& settings) {
  require_fits(rod, state);
  if (rod.other_material.has_value() != settings.others.has_value())
    throw InvalidInput("rod", "other materials than its laws of contact", "one with laws for each material");
  if (state.twist.size() == 0) return std::make_unique<ImplicitStep<3>>(rod, state, settings);
  return std::make_unique<ImplicitStep<4>>(rod, state, settings);
}

}  // namespace knot_utm
