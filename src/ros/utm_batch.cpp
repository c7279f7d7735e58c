// The tests of a batch, one after the other. A test that stands alone is a batch of one.
#include <utility>

#include "knot_utm/machine/accuracy.hpp"
#include "knot_utm/ros/launched.hpp"
#include "knot_utm/ros/order_of_test.hpp"
#include "knot_utm/ros/utm_node.hpp"
#include "knot_utm/run/claimed_folder.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/study/specimens.hpp"

namespace knot_utm {
namespace {

using std::chrono::steady_clock;

constexpr double kGapBetweenTests = 1.0;  // on /clock [s]

/// The same on both sides: the physics makes its steps by the same method.
ProgramRunner program_of(const Method& method) {
  return make_program(method, tolerances(method.physics, method.specimen, method.material).longest_step);
}

std::vector<Method> methods_of_specimens(const Method& method) {
  if (method.specimens.count == 1) check_fits(method);
  std::vector<Method> out;
  for (int number = 1; number <= method.specimens.count; ++number) out.push_back(method_of_specimen(method, number));
  return out;
}

}  // namespace

UtmNode::Batch UtmNode::batch_of(const StartTest::Request& request) const {
  Batch batch;
  batch.setup = set_up(asked_for(launched_.words, request));
  Method& method = batch.setup.method;
  const std::uint32_t count =
      request.specimens > 0 ? request.specimens : static_cast<std::uint32_t>(method.specimens.count);
  if (count > static_cast<std::uint32_t>(kMostInBatch))
    throw InvalidInput::sentence("specimens", std::to_string(count),
                                 std::to_string(count) +
                                     " specimens are asked for, but under ROS a batch may have at most " +
                                     std::to_string(kMostInBatch));
  method.specimens.count = static_cast<int>(count);
  try {
    batch.methods = methods_of_specimens(method);
  } catch (const InvalidInput& invalid) {
    throw invalid.in_file(batch.setup.file);
  }
  if (options_.record) {
    require_no_record_in(batch.setup.out, method);
    batch.folder = free_folder(batch.setup.out);
  }
  return batch;
}

std::string UtmNode::start_if_possible(const StartTest::Request& request) {
  // What is told in the same breath as this request: the last goal gets the result of its own test.
  if (state_ == State::kEnded && all_is_recorded()) see_to_the_next();
  if (leaves_) return "the launch is about to end";
  if (active()) return "a test is running";
  if (!has_specimen_) return "there is no specimen yet";
  if (run_ > 0 && !all_is_recorded()) return "the last test is still being recorded";
  Batch batch;
  try {
    batch = batch_of(request);
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
  if (!give_order(node_, order_of(batch_.setup.method, batch_.setup.out, place))) return false;
  if (specimen == 0) publish_method(batch_.setup.method);
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
  max_penetration_ = 0.0;
  state_ = State::kRunning;
  due_ = steady_clock::now();
  run_began_ = due_;
  factor_measured_ = due_;
  factor_time_ = 0.0;
  if (specimen == 0) write_verdict(options_.verdict, std::nullopt, batch_.folder);
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
  if (tested() < batch_.methods.size())
    ROS_WARN("the batch ended after %zu of %zu specimens", tested(), batch_.methods.size());
  finish_goal();
}

bool UtmNode::failed() const {
  return recorder_failed_ || physics_died_ || physics_gone_ || batch_.cut_off ||
         (program_ && program_->failed() && batch_.good_tests == 0);
}

}  // namespace knot_utm
