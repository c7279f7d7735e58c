#include <algorithm>

#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/scales.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

namespace {

constexpr double kStrandToGrip = 20.0;  // of straight strand between a knot and each grip [h]
constexpr double kDrawnTail = 30.0;     // [h]
constexpr double kDrawnPull = 80.0;     // of a pull: by then a drawn knot is tight, and slides if it does [h]
constexpr double kDrawnCoil = 4.0;      // radius of the bends of a drawn knot [h]

KnotDescription describe_drawn_knot() {
  KnotDescription out;
  out.name = "a file of config/knots/";
  out.title = "Knot from a file";
  out.keys = {"end_to_end", "tail", "preload", "refinement", "natural_curvature"};
  out.any_shape = true;
  out.tied_by_ends = true;
  out.drawn_coil = kDrawnCoil;
  out.error_study = ErrorStudy::kDrawnKnot;
  return out;
}

/// A knot that a file describes, of one or more ropes (knot_drawing.hpp). The grips hold ends of its ropes; pulling at
/// the free ones ties it.
class DrawnKnot final : public Knot {
 public:
  DrawnKnot() : Knot(describe_drawn_knot()) {}

  SpecimenOptions defaults(double h) const override {
    SpecimenOptions out;
    out.edge_length = kPaperKnottedEdge * (h / kPaperRadius);
    out.tail = kDrawnTail * h;
    return out;
  }

  void suit(const SpecimenOptions& known, double, double h, SpecimenOptions& out) const override {
    const bool on_posts = known.drawing->lower.empty() && known.drawing->upper.empty();
    out.end_to_end = least_end_to_end(*known.drawing, h) + (on_posts ? 0.0 : 2.0 * kStrandToGrip * h);
  }

  double pull(const SpecimenOptions&, double h) const override { return kDrawnPull * h; }
  void check(const SpecimenOptions&, double) const override {}

  Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                        const Mounting& mounting) const override {
    return draw(*specimen.drawing, size_of(specimen, material, mounting.refinement));
  }

  Supports supports(const SpecimenOptions& specimen, const Material& material) const override {
    Supports out;
    const double h = thickest(material);
    const Vec3 origin(0.0, 0.0, height_of_origin(*specimen.drawing, size_of(specimen, material, 1.0)));
    for (const KnotDrawing::Post& post : specimen.drawing->posts)
      (post.upper ? out.pins : out.posts).push_back(roller_of(post, h, origin));
    return out;
  }

 private:
  static DrawnSize size_of(const SpecimenOptions& specimen, const Material& material, double refinement) {
    const double h = thickest(material), others = material.other ? material.other->radius : material.radius;
    return {h, specimen.end_to_end, specimen.tail, specimen.edge_length, material.radius / h, others / h, refinement};
  }
};

}  // namespace

const Knot& drawn_knot() {
  static const DrawnKnot knot;
  return knot;
}

}  // namespace knot_utm
