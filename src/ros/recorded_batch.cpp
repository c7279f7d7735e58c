#include "knot_utm/ros/recorded_batch.hpp"

#include <utility>

namespace knot_utm {

RecordedBatch::RecordedBatch(const Method& method, ClaimedFolder claimed)
    : method_(method), claimed_(std::move(claimed)), table_(claimed_.path()) {}

const Method& RecordedBatch::method_of(int number) {
  while (static_cast<int>(drawn_.size()) < number)
    drawn_.push_back(draw_specimen(method_, static_cast<int>(drawn_.size()) + 1));
  return drawn_[static_cast<std::size_t>(number - 1)].method;
}

bool RecordedBatch::conclude(int number) {
  method_of(number);
  for (; concluded_ < number; ++concluded_) table_.add(drawn_[static_cast<std::size_t>(concluded_)]);
  table_.write();
  return number == method_.specimens.count;
}

}  // namespace knot_utm
