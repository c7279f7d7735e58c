#include "knot_utm/run/run_writer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

#include "knot_utm/contact/centreline_curve.hpp"
#include "knot_utm/grips/grips.hpp"
#include "knot_utm/numeric/pieces.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/tying/before_tying.hpp"
#include "knot_utm/tying/tied_loop.hpp"
#include "knot_utm/verdict/result_keys.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

constexpr int kDigits = 7;  // a tenth of a micrometre of a place less than a metre away
constexpr const char* kNames = "time,node,x,y,z,tension,twist,contact_force";
constexpr const char* kUnits = "s,-,m,m,m,N,rad/m,N/m";

/// A number behind a comma.
void put(std::string& text, double value) {
  std::array<char, 32> cell{','};
  // Adding zero turns -0 into 0.
  const auto end =
      std::to_chars(cell.data() + 1, cell.data() + cell.size(), value + 0.0, std::chars_format::general, kDigits);
  text.append(cell.data(), end.ptr);
}

/// NaN where there are too few.
double at(const Eigen::VectorXd& values, Eigen::Index i) {
  return i >= 0 && i < values.size() ? values[i] : Sample::kNone;
}

/// A loop that turned further around its rollers is told. The limit is half of the default roller's diameter, by choice
/// [h].
constexpr double kLargestLoopTurn = 6.0;

constexpr double kStopPassed = 0.01;  // a load that passed the crosshead's stop by more is told [of the stop]

bool holds_its_knot(const Results& results) {
  return results.break_place == BreakPlace::kNone && results.knot_type == KnotType::kKept;
}

/// Mass of all ropes [kg].
double mass_of(const Material& first, const Centreline& drawn) {
  double mass = 0.0;
  for (const Piece& rope : pieces_between(drawn.points.cols(), drawn.cuts)) {
    const RodMaterial& material = rope.begin > 0 && first.other ? *first.other : first;
    mass += specimen_scales(material).mass * length_of_pieces(drawn.points.middleCols(rope.begin, rope.nodes()), {});
  }
  return mass;
}

SpecimenFacts facts_of(const Method& method, const Centreline& drawn) {
  const SpecimenOptions& specimen = method.specimen;
  const KnotDescription& knot = knot_of(specimen).about();
  SpecimenFacts out;
  out.material = method.material;
  out.strands = bearing_strands(specimen);
  const double half_waves = method.machine.grips == GripKind::kClamps ? 2.0 : 1.0;
  if (knot.straight) out.buckling_factor = std::pow(half_waves * M_PI, 2.0);
  out.may_hold_a_knot = knot.may_hold_a_knot();
  out.follows_type = !knot.may_hold_a_knot() || type_is_followed(specimen);
  out.one_knot_in_a_strand = knot.knots == 1 && !knot.loop;
  out.free_ends = drawn.free_ends.size();
  if (specimen.drawing)
    for (const KnotDrawing::Reading& reading : specimen.drawing->readings) out.knot_readings.push_back(reading.name);
  for (const NodeForce& load : knot_of(specimen).supports(specimen, method.material).loads)
    out.dead_load += load.force.norm();
  if (specimen.to_be_tied && tied_by_preload(specimen)) out.preload = specimen.preload.value_or(Sample::kNone);
  out.knot_distance = marks_of(specimen, method.program);
  out.end_to_end = specimen.end_to_end;
  for (const ProgramStep& step : method.program)
    if (pulls(step->phase())) out.pull_speed = std::max(out.pull_speed, step->speed);
  out.inertia = inertia_factor(method.material, method.physics, slack_of(specimen, drawn));
  out.load_cell = method.machine.load_cell;
  out.errors = relative_errors(specimen, method.material, method.machine, method.physics);
  out.specification = method.specification;
  out.foreseen = foreseen_warnings(method);
  return out;
}

std::string in(const std::string& folder, const char* name) { return (std::filesystem::path(folder) / name).string(); }

}  // namespace

void ShapeSeries::add(const Record& record) {
  const bool whole = record.answer.status != BenchStatus::kBroken;
  if (!whole || !record.readings || record.shape.cols() == 0) return;
  if (records_ % stride_ == 0 && kept_.size() == kMost) {
    for (std::size_t i = 1; 2 * i < kMost; ++i) kept_[i] = std::move(kept_[2 * i]);
    kept_.resize((kMost + 1) / 2);
    stride_ *= 2;
  }
  Shape shape{record.answer.time, record.shape, record.tension, *record.readings};
  at_the_end_.clear();
  (records_ % stride_ == 0 ? kept_ : at_the_end_).push_back(std::move(shape));
  ++records_;
}

void ShapeSeries::add_parted(double time, const Points& shape) { at_the_end_.push_back({time, shape, {}, {}}); }

std::string ShapeSeries::csv() const {
  const bool several = !cuts_.empty();
  std::string text = kNames + std::string(several ? ",rope\n" : "\n") + kUnits + (several ? ",-\n" : "\n");
  for (const std::vector<Shape>* shapes : {&kept_, &at_the_end_})
    for (const Shape& shape : *shapes) write(shape, text);
  return text;
}

void ShapeSeries::write(const Shape& shape, std::string& text) const {
  std::string time;
  put(time, shape.time);
  int rope = 0;
  for (const Piece& piece : pieces_between(shape.points.cols(), cuts_)) {
    const std::string end = cuts_.empty() ? "\n" : ',' + std::to_string(++rope) + '\n';
    for (Eigen::Index i = piece.begin; i < piece.end; ++i) {
      const bool first = i == piece.begin, last = i + 1 == piece.end;
      text.append(time, 1);
      text += ',' + std::to_string(i);
      for (Eigen::Index k = 0; k < 3; ++k) put(text, shape.points(k, i));
      put(text, last ? Sample::kNone : at(shape.tension, i));
      put(text, first || last ? Sample::kNone : at(shape.readings.twist_rate, i - 1));
      put(text, at(shape.readings.contact_load, i));
      text += end;
    }
  }
}

RunWriter::RunWriter(const std::string& folder, const Method& method, const Centreline& drawn)
    : folder_(folder),
      cuts_(drawn.cuts),
      curve_(in(folder, "curve.csv"), std::isfinite(method.machine.stiffness)),
      full_curve_(in(folder, "curve_full.csv"), std::isfinite(method.machine.stiffness)),
      shapes_(drawn.cuts) {
  static_cast<SpecimenFacts&>(known_) = facts_of(method, drawn);
  known_.warnings = speed_warnings(method);
  known_.version = version();
  known_.weight = method.physics.gravity.norm() * mass_of(method.material, drawn);
  hung_ = hung_weight(method.specimen, method.material);
  if (rollers_hold(method.specimen, method.machine)) radius_on_rollers_ = method.material.radius;
  far_side_held_ = method.machine.far_side == FarSide::kHeld;
}

void RunWriter::add(const Record& record) {
  const Sample& sample = record.answer;
  wall_time_ = record.wall_time;
  for (const Sample& step : record.steps) {
    // A bench that has failed answers with the last good step again.
    if (!samples_.empty() && step.time <= samples_.back().time) continue;
    full_curve_.write(step);
    follow_stop(record.command, step);
    samples_.push_back(step);
    program_steps_.push_back(record.command.step);
  }
  if (sample.status == BenchStatus::kFailed) return;
  const bool mounted = sample.phase != Phase::kIdle && !forms(sample.phase);
  const bool whole = sample.status != BenchStatus::kBroken;
  if (mounted && record.shape.cols() > 0 && whole) turn_.add(record.shape);
  shapes_.add(record);
  cell_readings_.add(record, [this](const Sample& reading) { add_reading(reading); });
  if (samples_.empty() || sample.time > samples_.back().time) {
    samples_.push_back(sample);
    program_steps_.push_back(record.command.step);
  } else {
    samples_.back() = sample;
  }
}

void RunWriter::follow_stop(const Command& command, const Sample& step) {
  const double stop = command.stop_load, sense = command.velocity < 0.0 ? -1.0 : 1.0;
  const double passed = sense * (balanced_load(step) - stop) / std::abs(stop);
  if (stop == 0.0 || !(passed > std::max(passed_stop_, kStopPassed))) return;
  passed_stop_ = passed;
  stop_ = stop;
}

void RunWriter::add_reading(const Sample& reading) {
  if (!readings_.empty() && !(reading.time > readings_.back().time)) return;
  curve_.write(reading);
  readings_.push_back(reading);
}

std::vector<std::string> RunWriter::warnings_of_turn(double weight) const {
  if (!radius_on_rollers_ || !(turn_.largest() > kLargestLoopTurn * *radius_on_rollers_)) return {};
  return {"the loop turned around its rollers by " + format_number(std::round(turn_.largest() / *radius_on_rollers_)) +
          " radii of the rod, which carries its knots along" + (weight > 0.0 ? ": physics.gravity turns it" : "") +
          (far_side_held_
               ? ", though machine.far_side holds it: fixed rollers with machine.roller_friction would keep it in place"
               : "; machine.far_side: held or machine.roller_friction keeps it in place")};
}

MadeResults RunWriter::finish(const TestEnd& end, const Points& final_shape, const ResultsOptions& options) {
  cell_readings_.end([this](const Sample& reading) { add_reading(reading); });
  const Results results = analyse(samples_, readings_, end.ended_by, radius_on_rollers_.has_value(), hung_,
                                  known_.knot_distance, program_steps_);
  RunFacts facts = known_;
  facts.reason = end.reason;
  facts.wall_time = wall_time_;
  facts.peak_memory = options.ran_here ? peak_memory() : 0;
  facts.ends_with_hold = !samples_.empty() && samples_.back().phase == Phase::kHold;
  if (facts.ends_with_hold && facts.one_knot_in_a_strand && holds_its_knot(results) && final_shape.cols() > 0)
    facts.knot_hole = hole_diameter(sampled_centreline(final_shape), facts.material.radius);
  if (passed_stop_ > 0.0)
    facts.warnings.push_back("the load passed the " + short_number(stop_) + " N at which the crosshead stopped by " +
                             short_number(100.0 * passed_stop_) + " %");
  for (const std::vector<std::string>& more : {warnings_of_turn(facts.weight), options.warnings})
    facts.warnings.insert(facts.warnings.end(), more.begin(), more.end());

  if (final_shape.cols() > 0) write_centreline(in(folder_, "final_shape.csv"), final_shape, cuts_);
  if (!shapes_.empty()) {
    if (samples_.back().status == BenchStatus::kBroken) shapes_.add_parted(samples_.back().time, final_shape);
    write_whole(in(folder_, "shapes.csv"), shapes_.csv());
  }
  write_whole(in(folder_, "result.yaml"), result_yaml(results, facts));
  return {results, facts, curve_.rows(), full_curve_.rows()};
}

MadeResults make_results(const std::string& folder, const Method& method, const ResultsOptions& options) {
  SamplesReader samples(folder);
  RunWriter writer(folder, method,
                   specimen_centreline(method.specimen, method.material, method.machine, method.physics));
  Record record;
  while (samples.next(record)) writer.add(record);
  ResultsOptions more = options;
  if (samples.torn_bytes() > 0)
    more.warnings.emplace_back("the last command in samples.csv was cut off as it was written, and is left out");
  return writer.finish(samples.end().value_or(options.without_end), samples.final_shape(), more);
}

}  // namespace knot_utm
