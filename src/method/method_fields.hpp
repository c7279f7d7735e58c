#pragma once

#include <array>
#include <limits>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/contact/friction.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/words/fields.hpp"

/// All keys of a method with their ranges, section by section. Each step of the program has its own (Step::keys).
namespace knot_utm::fields {

/// The keys of all laws of a kind. Those that the chosen law does not have may stand with their plain value only
/// (method_check.cpp).
template <class Registry, class Number>
void law_keys(Fields& f, LawOptions<Number>& o) {
  for (const LawKey& key : Registry::keys()) {
    std::optional<double> value = o.value(key.name);
    const Range range{key.min, key.max, key.unit};
    const bool automatic = key.otherwise == LawDefault::kAccuracy || key.otherwise == LawDefault::kCreep;
    const char* word = automatic ? "auto" : "";
    f.optional_number(key.name, value, range, word, value);
    o.set(key.name, value);
  }
}

/// A law by its name, and its keys. Where there is only one law of a kind there is nothing to choose, and no name.
template <class Registry, class Number>
void chosen_law(Fields& f, const char* name, LawOptions<Number>& o) {
  if constexpr (Registry::kCount > 1) f.choice(name, o.law, Registry::kNames);
  law_keys<Registry>(f, o);
}

/// One that a file describes goes by the name of its drawing, which has been read.
inline void knot(Fields& f, SpecimenOptions& o) { f.choice("knot", o.knot, knot_names(o.drawing.get())); }

inline void specimen(Fields& f, SpecimenOptions& o) {
  knot(f, o);
  f.choice("handedness", o.handedness, std::array{"same", "opposite"});
  f.integer("turns", o.turns, 1, 4);
  f.file("file", o.file);
  f.scaled_number("knot_distance", o.knot_distance, Range{1e-4, 5.0, "m"});
  f.scaled_number("end_to_end", o.end_to_end, Range{1e-4, 20.0, "m"});
  f.scaled_number("length", o.length, Range{1e-4, 50.0, "m"});
  f.scaled_number("tail", o.tail, Range{1e-5, 2.0, "m"});
  f.optional_number("preload", o.preload, Range{1e-9, 1e9, "N"}, "auto");
  f.number("wrap", o.wrap, Range{0.1, 20.0, "rad"});
  f.scaled_number("post_diameter", o.post_diameter, Range{1e-5, 5.0, "m"});
  f.optional_number("tail_load", o.tail_load, Range{1e-9, 1e8, "N"}, "auto");
  f.number("natural_curvature", o.natural_curvature, Range{-1e4, 1e4, "1/m"});
  f.scaled_number("edge_length", o.edge_length, Range{1e-6, 0.1, "m"});
  f.optional_number("refinement", o.refinement, Range{1.0, 8.0, "-"}, "auto");
}

/// The names of CrossSection, in its order.
inline constexpr std::array kSections{"round", "soft"};

/// `name` is that of the file unless it is given.
inline void material(Fields& f, Material& o) {
  f.text("name", o.name);
  f.required_number("radius", o.radius, Range{1e-5, 0.05, "m"});
  f.required_number("density", o.density, Range{10.0, 25e3, "kg/m3"});
  f.required_number("stretching_stiffness", o.stretching_stiffness, Range{1e-6, 1e9, "N"});
  f.required_number("bending_stiffness", o.bending_stiffness, Range{1e-18, 1e6, "N m2"});
  f.required_number("twisting_stiffness", o.twisting_stiffness, Range{1e-18, 1e6, "N m2"});
  f.required_number("friction_coefficient", o.friction_coefficient, Range{0.0, 5.0, "-"});
  f.choice("section", o.section, kSections);
  f.optional_number("friction_couple", o.friction_couple, Range{0.0, 1.0, "-", true}, "auto");
  f.number("rolling_resistance", o.rolling_resistance, Range{0.0, 1.0, "-"});
  f.number("rolling_hysteresis", o.rolling_hysteresis, Range{0.0, 1.0, "-"});
  chosen_law<StretchingRegistry>(f, "stretching_law", o.stretching);
  chosen_law<BendingRegistry>(f, "bending_law", o.bending);
  f.optional_number("contact_stiffness", o.contact_stiffness, Range{1.0, 1e13, "N/m2"}, "auto");
  f.optional_number("tying_preload", o.tying_preload, Range{1e-9, 1e9, "N"}, "auto");
  f.optional_number("breaking_force", o.breaking_force, Range{1e-6, 1e8, "N"}, "none");
  f.section("breaking", [&o](Fields& breaking) { chosen_law<BreakingRegistry>(breaking, "law", o.breaking); });
  f.optional_number("yield_strain", o.yield_strain, Range{1e-6, 100.0, "-"}, "none");
  f.text("load_cell", o.load_cell);
  f.text("notes", o.notes);
}

inline void load_cell(Fields& f, LoadCellOptions& o) {
  f.text("name", o.name);
  f.scaled_number("capacity", o.capacity, Range{1e-3, 1e8, "N"});
  f.number("sampling_rate", o.sampling_rate, Range{1e-2, 1e4, "Hz"});
  f.number("accuracy", o.accuracy, Range{0.0, 0.1, "of the reading"});
  f.number("floor", o.floor, Range{0.0, 1.0, "of capacity"});
  f.number("resolution", o.resolution, Range{0.0, 1e5, "N"});
  f.number("noise", o.noise, Range{0.0, 1e5, "N"});
  f.integer("seed", o.seed, 0u, std::numeric_limits<unsigned>::max());
  f.integer("noise_run", o.noise_run, 0u, std::numeric_limits<unsigned>::max());
  f.text("notes", o.notes);
}

/// All keys of `machine` except the load cell, which may also be a name.
inline void machine(Fields& f, MachineOptions& o) {
  f.choice("grips", o.grips, std::array{"rollers", "nodes", "clamps"});
  f.scaled_number("roller_diameter", o.roller_diameter, Range{1e-5, 1.0, "m"});
  f.number("roller_friction", o.roller_friction, Range{0.0, 5.0, "-"});
  f.choice("far_side", o.far_side, std::array{"held", "free"});
  f.number("stiffness", o.stiffness, Range{1.0, kInfinity, "N/m"});
  f.scaled_number("travel", o.travel, Range{1e-3, 100.0, "m"});
}

inline void ends(Fields& f, EndOptions& o) {
  f.optional_number("load", o.load, Range{1e-6, 1e8, "N"}, "auto");
  f.optional_number("time", o.time, Range{1e-3, 1e8, "s"}, "none");
  f.optional_number("break_at_fraction_of_peak", o.break_at_fraction_of_peak, Range{0.0, 0.99, "of the peak"}, "none");
}

inline void physics(Fields& f, PhysicsOptions& o) {
  f.vector("gravity", o.gravity, Range{-100.0, 100.0, "m/s2"});
  f.section("friction", [&o](Fields& friction) {
    friction.choice("law", o.friction.law, kFrictionLawNames);
    friction.choice("at", o.friction_at, std::array{"surface", "centreline"});
    law_keys<FrictionRegistry>(friction, o.friction);
    friction.number_or_word("pair", o.pair_friction, Range{0.0, 5.0, "-"}, o.pair_rule, kPairRules);
  });
  f.section("contact", [&o](Fields& contact) {
    enum class Law { kSmooth } only = Law::kSmooth;
    contact.choice("law", only, std::array{"smooth"});
    contact.optional_number("tolerance", o.contact_tolerance, Range{1e-3, 0.5, "of the radius"}, "auto");
  });
  f.choice("twist", o.twist, std::array{"auto", "on", "off"});
  f.choice("accuracy", o.accuracy, std::array{"draft", "normal", "fine"});
  f.optional_number("drag", o.drag, Range{0.0, 100.0, "N s/m2"}, "auto");
  f.optional_number("inertia", o.inertia, Range{1e-12, 1e12, "of the own mass"}, "auto");
  f.optional_number("max_step", o.max_step, Range{1e-6, 0.5, "s"}, "auto");
  f.optional_number("residual", o.residual, Range{1e-12, 0.1, "of k_b/h2"}, "auto");
}

/// The keys that stand before the program, and those of the physics of the test behind it.
inline void before_program(Fields& top, Method& m) {
  top.section("specimen", [&](Fields& f) { specimen(f, m.specimen); });
  top.section("material", [&](Fields& f) { material(f, m.material); });
  if (m.material.other || top.lists_all()) {
    Material other = m.material.other ? *m.material.other : Material();
    top.section("other_material", [&](Fields& f) { material(f, other); });
  }
  top.section("machine", [&](Fields& f) {
    machine(f, m.machine);
    f.section("load_cell", [&](Fields& cell) { load_cell(cell, m.machine.load_cell); });
  });
}

inline void behind_program(Fields& top, Method& m) {
  top.section("ends", [&](Fields& f) { ends(f, m.ends); });
  top.section("physics", [&](Fields& f) { physics(f, m.physics); });
}

/// The texts in the head of a report, and its units.
inline void report(Fields& f, ReportOptions& o) {
  f.text("specimen_id", o.specimen_id, 80);
  f.text("standard", o.standard, 200);
  f.text("conditioning", o.conditioning, 200);
  f.text("terminations", o.terminations, 200);
  f.text("notes", o.notes, 4000);
  f.section("units", [&o](Fields& units) {
    units.choice("force", o.force, std::array{"N", "kN", "lbf"});
    units.choice("length", o.length, std::array{"mm", "in", "m"});
  });
}

/// The limits of one number of result.yaml, in the unit of that file.
inline void requirement(Fields& f, Requirement& o) {
  f.optional_number("min", o.min, Range{-1e12, 1e12, "-"}, "none");
  f.optional_number("max", o.max, Range{-1e12, 1e12, "-"}, "none");
}

}  // namespace knot_utm::fields
