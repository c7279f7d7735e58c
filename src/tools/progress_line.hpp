#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "knot_utm/machine/program_runner.hpp"

namespace knot_utm {

/// A line that shows the progress of a test and is rewritten a few times a second. It appears on a terminal only.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet) : on_(!quiet && isatty(STDERR_FILENO) != 0) {}
  ~ProgressLine() { end(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const Sample& sample, const ProgramRunner& program, double wall_time) {
    if (!on_ || wall_time < next_) return;
    next_ = wall_time + 0.2;
    shown_ = true;
    const double factor = sample.time / wall_time;
    const double left = factor > 0.0 ? program.time_left() / factor : 0.0;
    std::fprintf(stderr, "\r%-8s %5.1f %%  s %8.2f mm  F %10.4g N  %6.1f x real time  %5.0f s left ",
                 phase_name(sample.phase), 100.0 * program.progress(), 1e3 * sample.extension, sample.load, factor,
                 left);
    std::fflush(stderr);
  }

  /// The same for tests that run at the same time.
  void show(int ended, int count) {
    if (!on_) return;
    shown_ = true;
    const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    std::fprintf(stderr, "\r%d of %d specimens tested  %5.0f s left ", ended, count, passed / ended * (count - ended));
    std::fflush(stderr);
  }

  /// Ends the line, so that the next output begins on a new one.
  void end() {
    if (shown_) std::fputc('\n', stderr);
    shown_ = false;
  }

 private:
  bool on_;
  bool shown_ = false;
  double next_ = 0.0;  ///< wall time of the next update [s]
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace knot_utm
