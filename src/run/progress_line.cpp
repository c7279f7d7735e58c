#include "knot_utm/run/progress_line.hpp"

#include <unistd.h>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

ProgressLine::ProgressLine(std::FILE* out) : out_(out && isatty(fileno(out)) != 0 ? out : nullptr) {}

void ProgressLine::show(const Sample& sample, const ProgramRunner& program, double wall_time) {
  if (!out_ || wall_time < next_) return;
  next_ = wall_time + 0.2;
  shown_ = true;
  const double factor = sample.time / wall_time;
  const double left = factor > 0.0 ? program.time_left() / factor : 0.0;
  std::fprintf(out_, "\r%-8s %5.1f %%  s %8.2f mm  F %10.4g N  %6.1f x real time  %5.0f s left ",
               phase_name(sample.phase), 100.0 * program.progress(), 1e3 * sample.extension, sample.load, factor, left);
  std::fflush(out_);
}

void ProgressLine::show(int ended, int count) {
  if (!out_) return;
  shown_ = true;
  const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  std::fprintf(out_, "\r%d of %d specimens tested  %5.0f s left ", ended, count, passed / ended * (count - ended));
  std::fflush(out_);
}

void ProgressLine::end() {
  if (shown_) std::fputc('\n', out_);
  shown_ = false;
}

}  // namespace knot_utm
