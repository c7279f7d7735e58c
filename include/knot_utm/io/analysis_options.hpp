#pragma once

namespace knot_utm {

/// The `analysis` section of a method: which further evaluations are asked for, beyond those of every test.
struct AnalysisOptions {
  bool margin = false;  ///< safety margin of a knot that slides (analysis/margin.hpp)
};

}  // namespace knot_utm
