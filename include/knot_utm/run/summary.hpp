#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include "knot_utm/analysis/comparison.hpp"
#include "knot_utm/program/program_runner.hpp"

namespace knot_utm {

/// A reading for a person: with the prefix of its unit that suits its size, and as many digits as its error leaves,
/// else four. "4.98 ± 0.24 N", "345.2 kN/m". `unit` is that of result.yaml.
std::string reading_text(double value, const std::string& unit, double error = 0.0);

/// The main readings of a run or a batch on at most ten lines, from the result.yaml or statistics.yaml in its folder,
/// which have all of them.
std::string run_summary(const std::string& folder);

/// The same of a comparison: each reading that one of the curves has, of A, of B, and their difference.
std::string comparison_summary(const Comparison& comparison, const std::string& file_a, const std::string& file_b);

/// A line that shows the progress of a test and is rewritten a few times a second.
class ProgressLine {
 public:
  /// `out`: where it appears, if that is a terminal; null: nowhere.
  explicit ProgressLine(std::FILE* out);
  ~ProgressLine() { end(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const Sample& sample, const ProgramRunner& program, double wall_time);
  /// The same for tests that run at the same time.
  void show(int ended, int count);

  /// Ends the line, so that the next output begins on a new one.
  void end();

 private:
  std::FILE* out_;
  bool shown_ = false;
  double next_ = 0.0;  ///< wall time of the next update [s]
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Writes the input of a report on a comparison: comparison.yaml, as printed, and the two curves as compared, a.csv and
/// b.csv. Makes the folder and returns its path: `folder`, or, unless `overwrite`, the first numbered_folder of it that
/// has no other comparison, nor curves and pages of something else. The same two files compared again replace their
/// former comparison.
///
/// Throws InvalidInput (key "--report"), and writes nothing, where the files cannot be written, the folder holds a run,
/// or one of them would replace a file that was compared.
std::string write_comparison(const std::string& folder, const std::string& yaml, const Pull& a, const Pull& b,
                             const std::string& file_a, const std::string& file_b, bool overwrite = false);

}  // namespace knot_utm
