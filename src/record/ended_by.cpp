#include "knot_utm/record/ended_by.hpp"

#include "knot_utm/record/choice_names.hpp"

namespace knot_utm {
namespace {

constexpr ChoiceNames<EndedBy, 11> kEndNames{{{EndedBy::kNotYet, "not yet"},
                                              {EndedBy::kBreak, "break"},
                                              {EndedBy::kExtension, "extension"},
                                              {EndedBy::kLoad, "load"},
                                              {EndedBy::kTravel, "travel"},
                                              {EndedBy::kOperator, "operator"},
                                              {EndedBy::kSolver, "solver"},
                                              {EndedBy::kProgram, "program"},
                                              {EndedBy::kTime, "time"},
                                              {EndedBy::kUntangled, "untangled"},
                                              {EndedBy::kInterrupted, "interrupted"}}};

constexpr ChoiceNames<BreakPlace, 4> kBreakPlaceNames{{{BreakPlace::kNone, "none"},
                                                       {BreakPlace::kStrand, "strand"},
                                                       {BreakPlace::kKnot, "knot"},
                                                       {BreakPlace::kGrip, "grip"}}};

}  // namespace

const char* break_place_name(BreakPlace place) { return name_of(kBreakPlaceNames, place); }

const char* ended_by_name(EndedBy end) { return name_of(kEndNames, end); }

std::optional<EndedBy> ended_by_named(const std::string& name) { return choice_named(kEndNames, name); }

}  // namespace knot_utm
