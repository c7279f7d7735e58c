// The tests of a batch, one after the other. A test that stands alone is a batch of one.
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

}  // namespace

std::string UtmNode::start_if_possible(std::uint32_t count) {
  // What is told in the same breath as this request: the last goal gets the result of its own test.
  if (state_ == State::kEnded && all_is_recorded()) see_to_the_next();
  if (active()) return "a test is running";
  if (!has_specimen_) return "there is no specimen yet";
  if (run_ > 0 && !all_is_recorded()) return "the last test is still being recorded";
  if (count > static_cast<std::uint32_t>(kMostSpecimens))
    return "count is " + std::to_string(count) + ": it may be at most " + std::to_string(kMostSpecimens);
  try {
    draw_specimens(count > 0 ? static_cast<int>(count) : method_.specimens.count);
  } catch (const InvalidInput& invalid) {
    return invalid.what();
  }
  return start(0) ? "" : "the ROS master does not answer";
}

void UtmNode::draw_specimens(int count) {
  const Method batch = method_of_batch(method_, count);
  std::vector<Method> drawn;
  for (int number = 1; number <= count; ++number) {
    drawn.push_back(method_of_specimen(batch, number));
    program_of(drawn.back());  // refused now, and not once others have been tested
  }
  drawn_ = std::move(drawn);
  outcomes_.clear();
  good_tests_ = 0;
  stopped_ = false;
}

bool UtmNode::start(std::size_t specimen) {
  const BatchPlace place{static_cast<int>(specimen) + 1, static_cast<int>(drawn_.size())};
  if (!set_batch_place(node_, place)) return false;
  specimen_ = specimen;
  program_.emplace(program_of(drawn_[specimen]));
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
  factor_measured_ = due_;
  factor_time_ = 0.0;
  if (!place.alone()) ROS_INFO("%s is tested", place.text().c_str());
  send(program_->last());
  publish_status();
  return true;
}

void UtmNode::stop() {
  stopped_ = true;
  if (active()) program_->stop();
}

bool UtmNode::another_follows() const {
  return specimen_ + 1 < drawn_.size() && !stopped_ && !physics_died_ && !recorder_failed_;
}

void UtmNode::see_to_the_next() {
  if (outcomes_.size() > specimen_) return;  // it has been seen to
  outcomes_.push_back(outcome());
  if (!program_->failed()) ++good_tests_;
  if (another_follows()) {
    if (start(specimen_ + 1)) return;
    ROS_ERROR("the ROS master does not answer");
    stopped_ = true;
  }
  if (outcomes_.size() < drawn_.size()) {
    const std::string go_on = batch_directory_.empty() ? ""
                                                       : "; the others can be tested, once the launch has ended, by: "
                                                         "rosrun knot_utm tensile_test --resume " +
                                                             batch_directory_;
    ROS_WARN("the batch ended after %zu of %zu specimens%s", outcomes_.size(), drawn_.size(), go_on.c_str());
  }
  finish_goal();
}

bool UtmNode::failed() const {
  return recorder_failed_ || physics_died_ || (program_ && program_->failed() && good_tests_ == 0);
}

}  // namespace knot_utm
