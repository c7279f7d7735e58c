#pragma once

#include <chrono>
#include <cstdio>

#include "knot_utm/program/program_runner.hpp"

namespace knot_utm {

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

}  // namespace knot_utm
