#pragma once

#include <array>
#include <limits>
#include <string>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/contact/friction.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/words/fields.hpp"
#include "knot_utm/words/number.hpp"

/// All keys of a method, section by section: name, place in its struct, unit, range, default, and what is said of it
/// (Fields::says). From these rows they are read, written and listed, a report calls them, and `scripts/tables` writes
/// doc/method.md. Each step of the program has its own keys (Step::keys).
namespace knot_utm::fields {

/// What a key of a law is where a method does not give it, as the page of the keys has it.
inline std::string otherwise(const LawKey& key) {
  if (key.otherwise == LawDefault::kNone) return "required";
  if (key.otherwise == LawDefault::kPlain) return format_number(key.plain);
  return key.otherwise == LawDefault::kAccuracy ? "by `accuracy`"
                                                : "the slowest pull or cycle over 3.3, at most 0.31 radii/s";
}

/// The keys of all laws of a kind. Those that the chosen law does not have may stand with their plain value only
/// (method_check.cpp).
template <class Registry, class Number>
void law_keys(Fields& f, LawOptions<Number>& o) {
  for (const LawKey& key : Registry::keys()) {
    std::optional<double> value = o.value(key.name);
    const bool automatic = key.otherwise == LawDefault::kAccuracy || key.otherwise == LawDefault::kCreep;
    f.says(key.meaning, otherwise(key), Registry::with(key.name))
        .optional_number(key.name, value, Range{key.min, key.max, key.unit}, automatic ? "auto" : "", value);
    o.set(key.name, value);
  }
}

/// A law by its name, and its keys. Where there is only one law of a kind there is nothing to choose, and no name.
template <class Registry, class Number>
void chosen_law(Fields& f, const char* name, const char* meaning, LawOptions<Number>& o) {
  if constexpr (Registry::kCount > 1) f.says(meaning).choice(name, o.law, Registry::kNames);
  law_keys<Registry>(f, o);
}

/// One that a file describes goes by the name of its drawing, which has been read.
inline void knot(Fields& f, SpecimenOptions& o) {
  f.says("knot; by its name, or a [file](knots.md)").choice("knot", o.knot, knot_names(o.drawing.get()));
}

inline void specimen(Fields& f, SpecimenOptions& o) {
  knot(f, o);
  f.says("handedness of the two overhands").choice("handedness", o.handedness, std::array{"same", "opposite"});
  f.says("turns; how often the end goes through, or of a `multiple_fisherman` 2 or 3 windings of a tail",
         "1, of a `multiple_fisherman` 2")
      .integer("turns", o.turns, 1, 4);
  f.says("shape from; a CSV of `x,y,z` [m], a rod with two ends").file("file", o.file);
  f.says("knot distance e", "47.2 radii, or what `end_to_end` has room for")
      .scaled_number("knot_distance", o.knot_distance, Range{1e-4, 5.0, "m"});
  f.says("end to end L",
         "78.7 radii, overhand 0.7 `length`, capstan 30 radii from post to grip; more where knots or rollers need it")
      .scaled_number("end_to_end", o.end_to_end, Range{1e-4, 20.0, "m"});
  f.says("length of rod; of a straight one between the clamps",
         "overhand 315 radii, or more for a long `end_to_end`; straight 78.7 radii")
      .scaled_number("length", o.length, Range{1e-4, 50.0, "m"});
  f.says("tails; of a capstan from post to load",
         "9.45 radii for each winding; capstan 30 radii, or more for thick posts")
      .scaled_number("tail", o.tail, Range{1e-5, 2.0, "m"});
  f.says("pre-load F_p; it ties the knots",
         "the material's `tying_preload`, else 4 k_b/h², but at most half of `breaking_force`")
      .optional_number("preload", o.preload, Range{1e-9, 1e9, "N"}, "auto");
  f.says("angle around the post", "π").number("wrap", o.wrap, Range{0.1, 20.0, "rad"});
  f.says("post diameter", "12 radii").scaled_number("post_diameter", o.post_diameter, Range{1e-5, 5.0, "m"});
  f.says("tail load; dead, from the first instant", "k_b/h², at most k_s/100")
      .optional_number("tail_load", o.tail_load, Range{1e-9, 1e8, "N"}, "auto");
  f.says("natural curvature; from the reel; experimental")
      .number("natural_curvature", o.natural_curvature, Range{-1e4, 1e4, "1/m"});
  f.says("edge length of the mesh", "1.01 radii; straight, file, capstan at most 1.57")
      .scaled_number("edge_length", o.edge_length, Range{1e-6, 0.1, "m"});
  f.says(
       "refinement within the knots; by which edges there are shorter",
       "draft 1.3, normal 2 (2.25 with friction on the centrelines), fine 3; more in ropes "
       "[tied hard](model.md#8-accepting-a-step-and-choosing-its-length); 1, 1, 2 in loops of solid rods; 1 in a file")
      .optional_number("refinement", o.refinement, Range{1.0, 8.0, "-"}, "auto");
}

/// The names of CrossSection, in its order.
inline constexpr std::array kSections{"round", "soft"};

/// `name` is that of the file unless it is given.
inline void material(Fields& f, Material& o) {
  f.says("name", "the file's name").text("name", o.name);
  f.required_number("radius", o.radius, Range{1e-5, 0.05, "m"});
  f.required_number("density", o.density, Range{10.0, 25e3, "kg/m3"});
  f.required_number("stretching_stiffness", o.stretching_stiffness, Range{1e-6, 1e9, "N"});
  f.required_number("bending_stiffness", o.bending_stiffness, Range{1e-18, 1e6, "N m2"});
  f.says("twisting stiffness; at least a hundredth of `bending_stiffness`")
      .required_number("twisting_stiffness", o.twisting_stiffness, Range{1e-18, 1e6, "N m2"});
  f.required_number("friction_coefficient", o.friction_coefficient, Range{0.0, 5.0, "-"});
  f.says(
       "section; contact flattens and stretch thins [`soft` ones](model.md#sections-that-give), of solid rods with "
       "friction at the surface")
      .choice("section", o.section, kSections);
  f.says("friction's couple: 1 at the surface, 0 on the centreline", "1")
      .optional_number("friction_couple", o.friction_couple, Range{0.0, 1.0, "-", true}, "auto");
  f.says("resistance of contacts to rolling; over the radius, with `friction_couple` and friction")
      .number("rolling_resistance", o.rolling_resistance, Range{0.0, 1.0, "-"});
  f.says(
       "work lost as a soft contact rolls; [share of what goes into](model.md#where-friction-acts) the contact of a "
       "solid rod")
      .number("rolling_hysteresis", o.rolling_hysteresis, Range{0.0, 1.0, "-"});
  chosen_law<StretchingRegistry>(
      f, "stretching_law", "stretching law; `neo_hookean` is soft [rubber](model.md#2-elastic-energy)", o.stretching);
  chosen_law<BendingRegistry>(f, "bending_law",
                              "bending law; `plastic` [stays bent](model.md#2-elastic-energy) beyond `yield_strain`, "
                              "fibres of `frictional` rub",
                              o.bending);
  f.says("contact stiffness", "300 k_b/h⁴; soft: 0.77 k_s/(πh²)")
      .optional_number("contact_stiffness", o.contact_stiffness, Range{1.0, 1e13, "N/m2"}, "auto");
  f.optional_number("tying_preload", o.tying_preload, Range{1e-9, 1e9, "N"}, "auto");
  f.optional_number("breaking_force", o.breaking_force, Range{1e-6, 1e8, "N"}, "none");
  f.section("breaking", [&o](Fields& breaking) {
    chosen_law<BreakingRegistry>(
        breaking, "law", "what parts the rod; by `tension_and_bending` [knots weaken it](model.md#the-rod-parts)",
        o.breaking);
  });
  f.says("yield strain; of the outermost fibre")
      .optional_number("yield_strain", o.yield_strain, Range{1e-6, 100.0, "-"}, "none");
  f.text("load_cell", o.load_cell);
  f.text("notes", o.notes);
}

inline void load_cell(Fields& f, LoadCellOptions& o) {
  f.says("name", "the file's name").text("name", o.name);
  f.says("capacity of the cell",
         "2.5 times a strand's strength (else k_s), or the largest load asked for; rounded up to 1, 2, 5, 10 …")
      .scaled_number("capacity", o.capacity, Range{1e-3, 1e8, "N"});
  f.says("readings of the cell").number("sampling_rate", o.sampling_rate, Range{1e-2, 1e4, "Hz"});
  f.says("accuracy of the cell; bound on its systematic error")
      .number("accuracy", o.accuracy, Range{0.0, 0.1, "of the reading"});
  f.says("floor of the cell; below it that bound does not hold")
      .number("floor", o.floor, Range{0.0, 1.0, "of capacity"});
  f.says("resolution of the cell").number("resolution", o.resolution, Range{0.0, 1e5, "N"});
  f.says("noise of the cell, standard deviation").number("noise", o.noise, Range{0.0, 1e5, "N"});
  f.says("seed; of the systematic error and the noise")
      .integer("seed", o.seed, 0u, std::numeric_limits<unsigned>::max());
  f.says("noise run; experimental").integer("noise_run", o.noise_run, 0u, std::numeric_limits<unsigned>::max());
  f.text("notes", o.notes);
}

/// All keys of `machine` except the load cell, which may also be a name.
inline void machine(Fields& f, MachineOptions& o) {
  f.says("grips; rollers hold loops only").choice("grips", o.grips, std::array{"rollers", "nodes", "clamps"});
  f.says("roller diameter; of a loop", "12 radii")
      .scaled_number("roller_diameter", o.roller_diameter, Range{1e-5, 1.0, "m"});
  f.says("roller friction; of a capstan on its post")
      .number("roller_friction", o.roller_friction, Range{0.0, 5.0, "-"});
  f.says("far side of the loop; on rollers held half-way between them, or free to go round")
      .choice("far_side", o.far_side, std::array{"held", "free"});
  f.says("frame stiffness; `.inf`: rigid").number("stiffness", o.stiffness, Range{1.0, kInfinity, "N/m"});
  f.says("travel", "the largest of 1 m, 315 radii, and twice the extension asked for")
      .scaled_number("travel", o.travel, Range{1e-3, 100.0, "m"});
}

inline void ends(Fields& f, EndOptions& o) {
  f.says("load", "the cell's capacity").optional_number("load", o.load, Range{1e-6, 1e8, "N"}, "auto");
  f.optional_number("time", o.time, Range{1e-3, 1e8, "s"}, "none");
  f.says("break at no more than; the load has fallen to this, after 2 % of the cell's capacity; experimental")
      .optional_number("break_at_fraction_of_peak", o.break_at_fraction_of_peak, Range{0.0, 0.99, "of the peak"},
                       "none");
}

inline void physics(Fields& f, PhysicsOptions& o) {
  f.says("gravity; of tied loops from `mount` on").vector("gravity", o.gravity, Range{-100.0, 100.0, "m/s2"});
  f.section("friction", [&o](Fields& friction) {
    friction
        .says(
            "law; `memory` sticks, `smoothed` [creeps](bibliography.md#the-source-paper) (eq. 12), `power` grows with "
            "a power of the load, `rate` with the "
            "logarithm "
            "of the speed")
        .choice("law", o.friction.law, kFrictionLawNames);
    friction.says("at; strands roll at the `surface` only")
        .choice("at", o.friction_at, std::array{"surface", "centreline"});
    law_keys<FrictionRegistry>(friction, o.friction);
    friction.says("friction of two materials; or what it is of their coefficients")
        .number_or_word("pair", o.pair_friction, Range{0.0, 5.0, "-"}, o.pair_rule, kPairRules);
  });
  f.section("contact", [&o](Fields& contact) {
    enum class Law { kSmooth } only = Law::kSmooth;
    contact.choice("law", only, std::array{"smooth"});
    contact.says("tolerance", "by `accuracy`")
        .optional_number("tolerance", o.contact_tolerance, Range{1e-3, 0.5, "of the radius"}, "auto");
  });
  f.choice("twist", o.twist, std::array{"auto", "on", "off"});
  f.says("symmetry; `auto` solves one half of [symmetric rods](model.md#the-half-of-a-rod)")
      .choice("symmetry", o.symmetry, std::array{"auto", "off"});
  f.choice("accuracy", o.accuracy, std::array{"draft", "normal", "fine"});
  f.says("drag; per length of rod",
         "3/s times the accelerated mass per length, another for [light loops](model.md#3-the-implicit-step); "
         "overhand, file: none once pulled")
      .optional_number("drag", o.drag, Range{0.0, 100.0, "N s/m2"}, "auto");
  f.says("mass that is accelerated", "by the [bending time](model.md#3-the-implicit-step)")
      .optional_number("inertia", o.inertia, Range{1e-12, 1e12, "of the own mass"}, "auto");
  f.says("longest step", "by `accuracy`").optional_number("max_step", o.max_step, Range{1e-6, 0.5, "s"}, "auto");
  f.says("residual", "by `accuracy`").optional_number("residual", o.residual, Range{1e-12, 0.1, "of k_b/h2"}, "auto");
}

/// The texts in the head of a report, and its units.
inline void report(Fields& f, ReportOptions& o) {
  f.says("specimen id; in the head").text("specimen_id", o.specimen_id, 80);
  f.says("standard; in the head").text("standard", o.standard, 200);
  f.says("conditioning; before the test").text("conditioning", o.conditioning, 200);
  f.says("terminations; ends in the grips").text("terminations", o.terminations, 200);
  f.says("notes; below the head").text("notes", o.notes, 4000);
  f.section("units", [&o](Fields& units) {
    units.choice("force", o.force, std::array{"N", "kN", "lbf"});
    units.choice("length", o.length, std::array{"mm", "in", "m"});
  });
}

/// The keys that stand before the program, and those behind it.
inline void before_program(Fields& top, Method& m) {
  top.section("specimen", [&](Fields& f) { specimen(f, m.specimen); });
  top.section("material", [&](Fields& f) { material(f, m.material); });
  if (m.material.other || top.lists_all()) {
    Material other = m.material.other ? *m.material.other : Material();
    top.section("other_material", [&](Fields& f) { material(f, other); });
  }
  top.section("machine", [&](Fields& f) {
    machine(f, m.machine);
    f.says("load cell; a name, or a map of the keys below", "the material's, else one by the capacity below")
        .section("load_cell", [&](Fields& cell) { load_cell(cell, m.machine.load_cell); });
  });
}

inline void behind_program(Fields& top, Method& m) {
  top.section("ends", [&](Fields& f) { ends(f, m.ends); });
  top.section("physics", [&](Fields& f) { physics(f, m.physics); });
  top.section("report", [&](Fields& f) { report(f, m.report); });
}

/// The limits of one number of result.yaml, in the unit of that file.
inline void requirement(Fields& f, Requirement& o) {
  f.optional_number("min", o.min, Range{-1e12, 1e12, "-"}, "none");
  f.optional_number("max", o.max, Range{-1e12, 1e12, "-"}, "none");
}

}  // namespace knot_utm::fields
