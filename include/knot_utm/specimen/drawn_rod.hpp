#pragma once

#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {

/// knot: file. A rod whose centreline is in a CSV file (centreline_file.hpp). The grips hold its ends, the upper grip,
/// which moves along +z, the last one. The program does not know whether it is knotted.
class DrawnRod final : public Knot {
 public:
  DrawnRod();
  SpecimenOptions defaults(double h) const override;
  double pull(const SpecimenOptions& specimen, double h) const override;
  void check(const SpecimenOptions& specimen, double h) const override;
  Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                        const Mounting& mounting) const override;
};

}  // namespace knot_utm
