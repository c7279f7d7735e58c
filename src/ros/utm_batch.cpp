// The tests of a batch, one after the other. A test that stands alone is a batch of one.
#include <utility>

#include "knot_utm/machine/accuracy.hpp"
#include "knot_utm/ros/utm_node.hpp"
#include "knot_utm/study/specimens.hpp"

namespace knot_utm {
namespace {

using std::chrono::steady_clock;

constexpr double kGapBetweenTests = 1.0;  // on /clock [s]

/// The same on both sides: the physics makes its steps by the same method.
ProgramRunner program_of(const Method& method) {
  return make_program(method, tolerances(method.physics, method.specimen, method.material).longest_step);
}

std::vector<Method> methods_of_batch(const Method& method, int count) {
  const Method batch = method_of_batch(method, count);
  std::vector<Method> out;
  for (int number = 1; number <= count; ++number) out.push_back(method_of_specimen(batch, number));
  return out;
}

}  // namespace

std::string UtmNode::start_if_possible(std::uint32_t count) {
  // What is told in the same breath as this request: the last goal gets the result of its own test.
  if (state_ == State::kEnded && all_is_recorded()) see_to_the_next();
  if (active()) return "a test is running";
  if (!has_specimen_) return "there is no specimen yet";
  if (run_ > 0 && !all_is_recorded()) return "the last test is still being recorded";
  if (count > static_cast<std::uint32_t>(kMostInBatch))
    return "count is " + std::to_string(count) + ": it may be at most " + std::to_string(kMostInBatch);
  Batch batch;
  try {
    batch.methods = methods_of_batch(method_, count > 0 ? static_cast<int>(count) : method_.specimens.count);
  } catch (const InvalidInput& invalid) {
    return invalid.what();
  }
  std::swap(batch, batch_);
  if (start(0)) return "";
  std::swap(batch, batch_);
  return "the ROS master does not answer";
}

bool UtmNode::start(std::size_t specimen) {
  const BatchPlace place{static_cast<int>(specimen) + 1, static_cast<int>(batch_.methods.size())};
  if (!set_batch_place(node_, place)) return false;
  batch_.specimen = specimen;
  program_.emplace(program_of(batch_.methods[specimen]));
  if (run_ > 0) run_start_ = now_.toSec() + kGapBetweenTests;
  ++run_;
  recorded_ = 0;
  unrecorded_.clear();
  recorder_complete_ = false;
  recorder_failed_ = false;
  physics_died_ = false;
  single_steps_ = 0;
  sample_ = Sample();
  motion_pattern_.clear();
  readings_.clear();
  max_penetration_ = 0.0;
  state_ = State::kRunning;
  due_ = steady_clock::now();
  run_began_ = due_;
  factor_measured_ = due_;
  factor_time_ = 0.0;
  if (!place.alone()) ROS_INFO("%s is tested", place.text().c_str());
  send(program_->last());
  publish_status();
  return true;
}

void UtmNode::stop() {
  if (!active() && !another_follows()) return;
  batch_.stopped = true;
  if (active()) program_->stop();
}

bool UtmNode::another_follows() const {
  const bool ends = batch_.stopped || batch_.cut_off || physics_died_ || recorder_failed_;
  return batch_.specimen + 1 < batch_.methods.size() && !ends;
}

std::size_t UtmNode::tested() const {
  // Where one of these failed, the present specimen is left to be tested again.
  return batch_.outcomes.size() - (physics_died_ || recorder_failed_ ? 1 : 0);
}

void UtmNode::see_to_the_next() {
  if (batch_.outcomes.size() > batch_.specimen) return;  // it has been seen to
  batch_.outcomes.push_back(outcome());
  if (!program_->failed()) ++batch_.good_tests;
  if (another_follows()) {
    if (start(batch_.specimen + 1)) return;
    ROS_ERROR("the ROS master does not answer");
    batch_.cut_off = true;
  }
  if (tested() < batch_.methods.size()) {
    ROS_WARN("the batch ended after %zu of %zu specimens", tested(), batch_.methods.size());
    if (!batch_directory_.empty())
      ROS_WARN("once the launch has ended, the others can be tested by: %s",
               command_to_resume(batch_directory_).c_str());
  }
  finish_goal();
}

bool UtmNode::failed() const {
  return recorder_failed_ || physics_died_ || batch_.cut_off ||
         (program_ && program_->failed() && batch_.good_tests == 0);
}

}  // namespace knot_utm
