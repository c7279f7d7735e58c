#include <algorithm>
#include <memory>
#include <utility>

#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/machine_options.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/options.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "path.hpp"

namespace knot_utm {

namespace {

constexpr double kShippedLength = 0.25;  // of the shipped method, for the paper's radius [m]

/// knot: straight. A straight rod along the load axis. Its `length` is that between the grips, so that the load grows
/// by k_s/length per extension (`stretching_law: linear`).
class StraightRod final : public Knot {
 public:
  StraightRod() {
    about_.name = "straight";
    about_.title = "Straight rod";
    about_.keys = {"length"};
    about_.straight = true;
    about_.error_study = ErrorStudy::kStraight;
  }

  SpecimenOptions defaults(double h) const override {
    const double r = h / kPaperRadius;
    SpecimenOptions out;
    out.edge_length = kPaperEdge * r;
    out.length = kShippedLength * r;
    return out;
  }
  void suit(const SpecimenOptions& known, double, double h, SpecimenOptions& out) const override {
    out.edge_length = std::min(kPaperEdge * (h / kPaperRadius), known.length / 4.0);
  }
  double pull(const SpecimenOptions& specimen, double) const override { return specimen.length / 25.0; }
  void check(const SpecimenOptions& specimen, double) const override { check_edges_of_length(specimen); }

  Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                        const Mounting& mounting) const override {
    Centreline out = knot_utm::straight(specimen.length, material.radius, specimen.edge_length);
    if (!mounting.clamps) return out;
    // Each clamp holds one more edge, beyond `length`.
    const Eigen::Index nodes = out.points.cols() + 2;
    const double edge = out.length() / static_cast<double>(out.points.cols() - 1);
    out.points = Points::Zero(3, nodes);
    out.points.row(2).setLinSpaced(0.0, specimen.length + 2.0 * edge);
    out.points.row(2).array() -= edge;
    return out;
  }
  std::vector<HeldNode> held_lower(const Centreline& centreline, bool clamped) const override {
    return inwards(Knot::held_lower(centreline, clamped), clamped);
  }
  std::vector<HeldNode> held_upper(const Centreline& centreline, bool clamped) const override {
    return inwards(Knot::held_upper(centreline, clamped), clamped);
  }

 private:
  static std::vector<HeldNode> inwards(std::vector<HeldNode> held, bool clamped) {
    for (HeldNode& end : held)
      if (clamped) std::swap(end.node, end.next);
    return held;
  }
};

}  // namespace

std::unique_ptr<const Knot> straight_rod() { return std::make_unique<StraightRod>(); }

bool rollers_hold(const SpecimenOptions& specimen, const MachineOptions& machine) {
  return knot_of(specimen).about().loop && machine.grips == GripKind::kRollers;
}

bool clamps_hold(const SpecimenOptions& specimen, const MachineOptions& machine) {
  return machine.grips != GripKind::kNodes && !rollers_hold(specimen, machine);
}

bool clamp_turns(const SpecimenOptions& specimen, const MachineOptions& machine) {
  const bool holds_none = specimen.drawing && specimen.drawing->upper.empty();
  return clamps_hold(specimen, machine) && !knot_of(specimen).about().loop && !holds_none;
}

// Each of the others is defined in a file of this folder.
std::unique_ptr<const Knot> fisherman_knot();
std::unique_ptr<const Knot> multiple_fisherman_knot();
std::unique_ptr<const Knot> overhand_knot();
std::unique_ptr<const Knot> sketched_rod();
std::unique_ptr<const Knot> capstan();
std::unique_ptr<const Knot> sketched_knot();

const std::vector<const Knot*>& knots() {
  static const std::unique_ptr<const Knot> owned[] = {
      fisherman_knot(), multiple_fisherman_knot(), overhand_knot(), straight_rod(), sketched_rod(), capstan(),
      sketched_knot()};
  static const std::vector<const Knot*> all = [] {
    std::vector<const Knot*> out;
    for (const auto& knot : owned) out.push_back(knot.get());
    return out;
  }();
  return all;
}

const Knot& knot_of(KnotKind kind) { return *knots().at(static_cast<std::size_t>(kind)); }

int bearing_strands(const SpecimenOptions& specimen) {
  if (knot_of(specimen).about().loop) return 2;
  if (!specimen.drawing) return 1;
  const std::size_t upper = specimen.drawing->upper.size(), lower = specimen.drawing->lower.size();
  if (lower == 0 && upper == 0) return 2;  // around both posts
  return static_cast<int>(lower == 0 ? upper : upper == 0 ? lower : std::min(upper, lower));
}

bool one_knot_in_line(const SpecimenOptions& specimen) {
  const KnotDrawing* drawing = specimen.drawing.get();
  if (drawing == nullptr) return knot_of(specimen).about().knots == 1;
  return drawing->strands.size() == 1 && drawing->posts.empty() && drawing->lower.size() == 1 &&
         drawing->upper.size() == 1;
}

bool type_is_followed(const SpecimenOptions& specimen) {
  const KnotDrawing* drawing = specimen.drawing.get();
  const bool loose = drawing != nullptr && (drawing->strands.size() > 1 || drawing->has_free_ends());
  return knot_of(specimen).about().may_hold_a_knot() && !loose;
}

std::vector<std::string> knot_names(const KnotDrawing* drawing) {
  std::vector<std::string> out;
  for (const Knot* knot : knots())
    if (!knot->about().tied_by_ends) out.emplace_back(knot->about().name);  // a knot from a file has the name of that
  if (drawing != nullptr) out.push_back(drawing->name);
  return out;
}

namespace {

template <typename Which>
std::string listed_knots(Which which) {
  std::vector<std::string> names;
  for (const Knot* knot : knots())
    if (which(*knot)) names.emplace_back(knot->about().name);
  return listed(names);
}

}  // namespace

KnotKind knot_named(const std::string& name) {
  const std::vector<const Knot*>& all = knots();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Knot* knot) { return name == knot->about().name; });
  if (found == all.end())
    throw InvalidInput("specimen.knot", shown(name), listed_knots([](const Knot&) { return true; }));
  return static_cast<KnotKind>(found - all.begin());
}

std::string knots_with(const std::string& key) {
  return listed_knots([&](const Knot& knot) { return knot.has(key); });
}

std::string loops() {
  return listed_knots([](const Knot& knot) { return knot.about().loop; });
}

std::string knots_that_can_be_tied() {
  return listed_knots([](const Knot& knot) { return knot.about().can_be_tied(); });
}

double tying_load(const SpecimenOptions& specimen, const Material& material) {
  return specimen.preload.value_or(default_preload(material));
}

double hung_weight(const SpecimenOptions& specimen, const Material& material) {
  double parts = 0.0;
  if (specimen.drawing)
    for (const KnotDrawing::Pull& weight : specimen.drawing->weights) parts += weight.fraction;
  return parts > 0.0 ? parts * tying_load(specimen, material) : 0.0;
}

bool Knot::has(const std::string& key) const {
  if (key == "knot" || key == "edge_length") return true;
  return std::find(about_.keys.begin(), about_.keys.end(), key) != about_.keys.end();
}

std::vector<HeldNode> Knot::held_lower(const Centreline& centreline, bool) const {
  if (!centreline.held_upper.empty() || !centreline.held_lower.empty()) return centreline.held_lower;
  return {HeldNode{0, 1}};
}

std::vector<HeldNode> Knot::held_upper(const Centreline& centreline, bool) const {
  if (!centreline.held_upper.empty() || !centreline.held_lower.empty()) return centreline.held_upper;
  const int last = static_cast<int>(centreline.points.cols()) - 1;
  return {HeldNode{last, last - 1}};
}

}  // namespace knot_utm
