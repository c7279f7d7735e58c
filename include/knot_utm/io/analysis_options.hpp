#pragma once

namespace knot_utm {

/// The `analysis` section of a method: what is asked of the results beside what every test says.
struct AnalysisOptions {
  bool margin = false;  ///< how far a knot that slides is from opening (analysis/margin.hpp)
};

}  // namespace knot_utm
