#pragma once

#include <string>

#include "knot_utm/analysis/comparison.hpp"

namespace knot_utm {

/// Writes the input of a report on a comparison: comparison.yaml, as printed, and the two curves as compared, a.csv and
/// b.csv. Makes the folder and returns its path.
///
/// The folder is `folder`, unless another comparison, or curves and pages of something else, stand there. Then it is
/// the first of `folder-2`, `folder-3` and so on without such files. With `overwrite` it is always `folder`. The same
/// two files compared again replace their former comparison.
///
/// Throws InvalidInput (key "--report") where the files cannot be written, the folder holds a run, or one of them would
/// replace a file that was compared. Then nothing is written.
std::string write_comparison(const std::string& folder, const std::string& yaml, const Pull& a, const Pull& b,
                             const std::string& file_a, const std::string& file_b, bool overwrite = false);

}  // namespace knot_utm
