#include "knot_utm/run/record.hpp"

#include <algorithm>

namespace knot_utm {

void RodReadings::state(Archive& archive) {
  archive.list(twist_rate);
  archive.list(contact_load);
}

const Sample* cell_reading(const Record& record) {
  const auto parted = [](const Sample& sample) { return sample.status == BenchStatus::kBroken; };
  const auto step = std::find_if(record.steps.begin(), record.steps.end(), parted);
  if (step != record.steps.end()) return &*step;
  if (parted(record.answer)) return &record.answer;
  const bool read = record.command.read_cell || record.command.balance;
  return read && record.answer.status != BenchStatus::kFailed ? &record.answer : nullptr;
}

}  // namespace knot_utm
