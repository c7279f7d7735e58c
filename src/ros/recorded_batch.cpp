#include "knot_utm/ros/recorded_batch.hpp"

#include <utility>

#include "knot_utm/io/run_folder.hpp"

namespace knot_utm {

RecordedBatch::RecordedBatch(const Method& method, ClaimedFolder claimed)
    : method_(method), claimed_(std::move(claimed)), table_(claimed_.folder) {}

RecordedBatch RecordedBatch::begin(const Method& method, ClaimedFolder claimed) {
  begin_run_folder(claimed.folder, method);
  return {method, std::move(claimed)};
}

RecordedBatch RecordedBatch::go_on(const Method& method, ClaimedFolder claimed) { return {method, std::move(claimed)}; }

const Method& RecordedBatch::method_of(int number) {
  while (static_cast<int>(drawn_.size()) < number)
    drawn_.push_back(draw_specimen(method_, static_cast<int>(drawn_.size()) + 1));
  return drawn_[static_cast<std::size_t>(number - 1)].method;
}

bool RecordedBatch::conclude(int number) {
  method_of(number);
  for (; concluded_ < number; ++concluded_) table_.add(drawn_[static_cast<std::size_t>(concluded_)]);
  table_.write();
  if (number < method_.specimens.count) return false;
  claimed_.journal.remove();
  return true;
}

}  // namespace knot_utm
