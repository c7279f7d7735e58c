#pragma once

#include <stdexcept>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// One field of a sample.
template <typename Member>
struct SampleField {
  const char* name;
  const char* unit;  ///< "-": none
  const char* meaning;
  /// The field of a Sample, or of anything else that has one of this name: of its message, too.
  Member of;
};

template <typename Member>
SampleField(const char*, const char*, const char*, Member) -> SampleField<Member>;

#define KNOT_UTM_FIELD(name, unit, meaning)                                 \
  SampleField {                                                             \
#name, unit, meaning, [](auto& sample) -> auto& { return sample.name; } \
  }

/// All fields of a sample, in the order of samples.csv. From these rows come samples.csv, the message with both of its
/// conversions, and the units in curve files. A new field is a row here and a member of Sample; `scripts/tables` writes
/// its line of msg/KnotState.msg.
inline constexpr auto kSampleFields = std::make_tuple(
    KNOT_UTM_FIELD(sequence, "-", "of the command that this answers"), KNOT_UTM_FIELD(time, "s", "time of the test"),
    KNOT_UTM_FIELD(phase, "-", "phase of the test: idle, a step of the program, or done (tensile_test --list-phases)"),
    KNOT_UTM_FIELD(displacement, "m", "of the crosshead"),
    KNOT_UTM_FIELD(extension, "m", "s, growth of the end-to-end distance since balance"),
    KNOT_UTM_FIELD(end_to_end, "m", "L, between the grips"),
    KNOT_UTM_FIELD(knot_distance, "m", "e, between the two knots; NaN: no two knots"),
    KNOT_UTM_FIELD(load, "N",
                   "as the cell reads it at a sampling instant, else the balanced true force on the upper grip"),
    KNOT_UTM_FIELD(balance_offset, "N", "true force on the upper grip that the cell reads as zero"),
    KNOT_UTM_FIELD(force_upper, "N", "true force on the upper grip"),
    KNOT_UTM_FIELD(force_lower, "N", "true force on the lower grip"),
    KNOT_UTM_FIELD(tail_force, "N", "of each knot, on its tail's grip while it is tied; NaN: nothing holds its tail"),
    KNOT_UTM_FIELD(excess_length, "m", "of each knot, rod length hidden in it; NaN: not read"),
    KNOT_UTM_FIELD(tail_length, "m",
                   "of each free end of a knot that a file describes, rod length outside the knot; NaN: its rope "
                   "touches none"),
    KNOT_UTM_FIELD(max_penetration, "fraction of the rod's radius", "deepest contact"),
    KNOT_UTM_FIELD(normal_force, "N", "sum over all contacts of rod with rod"),
    KNOT_UTM_FIELD(contacts, "-", "contact points that carry force"),
    KNOT_UTM_FIELD(fastest_node, "m/s", "speed of the fastest node"),
    KNOT_UTM_FIELD(stretching_energy, "J", "stored in the rod by stretching"),
    KNOT_UTM_FIELD(bending_energy, "J", "stored in the rod by bending"),
    KNOT_UTM_FIELD(twisting_energy, "J", "stored in the rod by twisting"),
    KNOT_UTM_FIELD(contact_energy, "J", "stored in all contacts"), KNOT_UTM_FIELD(kinetic_energy, "J", "of the rod"),
    KNOT_UTM_FIELD(grip_work, "J", "done by grips and fixtures since the start"),
    KNOT_UTM_FIELD(dissipation, "J", "by friction, drag and bending since the start"),
    KNOT_UTM_FIELD(friction_loss, "J", "part of the dissipation that is by friction"),
    KNOT_UTM_FIELD(plastic_loss, "J",
                   "part of the dissipation that is in the rod: bends that yield or whose fibres slide"),
    KNOT_UTM_FIELD(numerical_dissipation, "J",
                   "by the time steps since the start, beside friction and drag; may be negative"),
    KNOT_UTM_FIELD(reweighting_loss, "J",
                   "of contact energy since the start, as weights of contacts changed; negative: gained"),
    KNOT_UTM_FIELD(moment_imbalance, "N m", "size of the sum of all moments on the rod, inertia and drag among them"),
    KNOT_UTM_FIELD(steps, "-", "time steps since the start"),
    KNOT_UTM_FIELD(rejected_steps, "-", "time steps thrown away since the start"),
    KNOT_UTM_FIELD(newton_iterations, "-", "iterations of Newton's method since the start"),
    KNOT_UTM_FIELD(knot_type, "-",
                   "whether the specimen is the knot that it began as: kept, changed (it came undone, or is another "
                   "one now) or crossed (the rod ran through itself)"),
    KNOT_UTM_FIELD(status, "-",
                   "how the specimen stands after the command: running, phase done, not equilibrated, broken or "
                   "failed"),
    KNOT_UTM_FIELD(message, "-", "why, where the status is BROKEN, FAILED or NOT_EQUILIBRATED"),
    KNOT_UTM_FIELD(highest_load, "N",
                   "balanced true force on the upper grip: largest of the time steps since the last command; of a time "
                   "step its own"),
    KNOT_UTM_FIELD(lowest_load, "N",
                   "balanced true force on the upper grip: smallest of the time steps since the last command; of a "
                   "time step its own"),
    KNOT_UTM_FIELD(break_arclength, "m", "of the place where the rod parted, from its first node; NaN: it is whole"),
    KNOT_UTM_FIELD(break_place, "-",
                   "where the rod parted: none (it is whole), strand (where it lies free), knot (against another "
                   "strand) or grip (on a roller, or where a clamp or node holds it)"),
    KNOT_UTM_FIELD(knots_force, "N",
                   "between the coils of the two knots, sum of normal forces; above 0 the knots touch each other; NaN: "
                   "no two knots"),
    KNOT_UTM_FIELD(knot_on_roller, "N",
                   "of the rollers on the knots or their tails, sum of normal forces; NaN: no two knots"),
    KNOT_UTM_FIELD(raw_extension, "m",
                   "travel of the crosshead since balance; NaN: the frame is rigid, on which it is the extension"),
    KNOT_UTM_FIELD(turn, "rad", "of the upper clamp about the load axis, right-handed about up"),
    KNOT_UTM_FIELD(torque, "N m",
                   "of the upper clamp on the rod in this sense; NaN: the rod has no twist, or not one strand is held"),
    KNOT_UTM_FIELD(knot_readings, "m",
                   "of an answer: what the knot's file reads of it, in its order; NaN: there is no such loop"),
    KNOT_UTM_FIELD(half_iterations, "-",
                   "those iterations of Newton's method that solved one half of a symmetric rod"));

#undef KNOT_UTM_FIELD

/// Calls `visit` with every field of a sample, in order.
template <typename Visit>
constexpr void visit_sample_fields(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, kSampleFields);
}

/// What Sample holds in a field.
template <typename Field>
using ValueOf = std::remove_reference_t<decltype(std::declval<const Field&>().of(std::declval<Sample&>()))>;

/// The last values of the enumerations in a sample, all of which begin with 0.
constexpr Phase last_of(Phase) { return kHighestPhase; }
constexpr KnotType last_of(KnotType) { return KnotType::kCrossed; }
constexpr BenchStatus last_of(BenchStatus) { return BenchStatus::kFailed; }
constexpr BreakPlace last_of(BreakPlace) { return BreakPlace::kGrip; }

/// All fields as CSV with the columns field, type (that of the message), unit and meaning.
std::string sample_fields_csv();

/// The unit of the field of this name. A name that is none does not compile where the unit is a constant.
constexpr const char* sample_unit(std::string_view name) {
  const char* unit = nullptr;
  visit_sample_fields([&](const auto& field) {
    if (name == field.name) unit = field.unit;
  });
  return unit ? unit : throw std::invalid_argument("a sample has no such field");
}

}  // namespace knot_utm
