#include "knot_utm/record/sample.hpp"

#include "knot_utm/record/choice_names.hpp"
#include "knot_utm/record/sample_fields.hpp"

namespace knot_utm {
namespace {

constexpr ChoiceNames<BreakPlace, 4> kBreakPlaceNames{{{BreakPlace::kNone, "none"},
                                                       {BreakPlace::kStrand, "strand"},
                                                       {BreakPlace::kKnot, "knot"},
                                                       {BreakPlace::kGrip, "grip"}}};

}  // namespace

const char* break_place_name(BreakPlace place) { return name_of(kBreakPlaceNames, place); }

// In the order of a checkpoint: another one is another version of it.
void Command::state(Archive& archive) {
  archive(sequence, time, displacement, velocity, step);
  archive.choice("phase", phase, last_of(phase));
  archive(speed, duration, balance, read_cell);
}

void Sample::state(Archive& archive) {
  visit_sample_fields([&](const auto& field) {
    auto& value = field.of(*this);
    if constexpr (std::is_enum_v<std::remove_reference_t<decltype(value)>>) {
      archive.choice(field.name, value, last_of(value));
    } else {
      archive(value);
    }
  });
}

}  // namespace knot_utm
