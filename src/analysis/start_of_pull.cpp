#include "knot_utm/analysis/start_of_pull.hpp"

#include <algorithm>

#include "knot_utm/record/phase.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

// The start is this fraction of the whole extension, by choice: a wave that the pull begins with has crossed the
// specimen by then.
constexpr double kStart = 0.01;

}  // namespace

std::optional<GripForces> forces_at_start(const std::vector<Sample>& samples) {
  const auto first =
      std::find_if(samples.begin(), samples.end(), [](const Sample& sample) { return pulls(sample.phase); });
  if (first == samples.end()) return std::nullopt;
  double end = first->extension;
  for (auto sample = first; sample != samples.end(); ++sample)
    if (pulls(sample->phase)) end = std::max(end, sample->extension);
  const double near = first->extension + kStart * (end - first->extension);
  // A balance in between has another extension before the pull than in it.
  const Sample& before = first == samples.begin() ? *first : *(first - 1);
  GripForces most{before.force_upper, before.force_lower};
  for (auto sample = first; sample != samples.end() && sample->extension <= near; ++sample) {
    if (sample->status == BenchStatus::kBroken) break;
    const GripForces now{sample->force_upper, sample->force_lower};
    if (now.difference() > most.difference()) most = now;
  }
  return most;
}

}  // namespace knot_utm
