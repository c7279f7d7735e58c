#include "knot_utm/analysis/snap.hpp"

#include <cmath>

#include "knot_utm/record/phase.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

constexpr double kLeft = 0.9;      // of the force before
constexpr double kGivenUp = 0.02;  // of the stored energy
constexpr double kPutIn = 0.5;     // work of the grips, of what is given up

struct Moment {
  double extension, force, stored, work;
};

/// Those of a pull that reach a new largest extension, up to a break.
std::vector<Moment> pulled(const std::vector<Sample>& samples) {
  std::vector<Moment> out;
  for (const Sample& sample : samples) {
    if (sample.status == BenchStatus::kBroken) break;
    if (!pulls(sample.phase) || !(out.empty() || sample.extension > out.back().extension)) continue;
    const double stored =
        sample.stretching_energy + sample.bending_energy + sample.twisting_energy + sample.contact_energy;
    out.push_back({sample.extension, sample.force_upper, stored, sample.grip_work});
  }
  return out;
}

bool snaps(const Moment& start, const Moment& before, const Moment& after) {
  const double given_up = before.stored - after.stored;
  return after.force <= kLeft * before.force && given_up >= kGivenUp * before.stored &&
         after.work - before.work <= kPutIn * given_up && after.stored >= start.stored;
}

}  // namespace

std::optional<Snap> snap(const std::vector<Sample>& samples) {
  std::optional<Snap> out;
  const std::vector<Moment> pull = pulled(samples);
  for (std::size_t i = 0; i < pull.size(); ++i) {
    const Moment& before = pull[i];
    if (!(before.force > 0.0)) continue;
    // No more can be given up than what is above the energy at the start.
    const double most = kPutIn * (before.stored - pull.front().stored);
    for (std::size_t j = i + 1; j < pull.size() && pull[j].work - before.work <= most; ++j) {
      const double drop = before.force - pull[j].force;
      if (!(out && drop <= out->drop) && snaps(pull.front(), before, pull[j])) out = Snap{before.extension, drop};
    }
  }
  return out;
}

}  // namespace knot_utm
