// The operator's hand on the machine: the action utm/move.
#include <cmath>

#include "knot_utm/program/program.hpp"
#include "knot_utm/ros/utm_node.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

/// Why a goal cannot be gone to; empty: it can.
std::string fault_of(const MoveGoal& goal) {
  for (const auto& [name, value] : {std::pair{"extension", goal.extension}, {"load", goal.load}})
    if (!std::isfinite(value))
      return std::string(name) + ": " + format_number(value) + " is refused: a number is allowed";
  if (goal.speed >= 0.0 && goal.speed <= kFastestCrosshead) return "";
  return "speed: " + format_number(goal.speed) + " is refused: 0 to " + format_number(kFastestCrosshead) +
         " m/s is allowed";
}

}  // namespace

void UtmNode::on_move(Moves::GoalHandle goal) {
  const boost::shared_ptr<const MoveGoal> got = goal.getGoal();
  if (!got) return;
  const MoveGoal& asked = *got;
  const std::string why_not = active() ? fault_of(asked) : "no test is running: utm/start_test starts one";
  if (!why_not.empty()) return goal.setRejected(MoveResult(), why_not);
  if (move_) move_->setCanceled(MoveResult(), "another goal came");
  move_ = goal;
  move_->setAccepted("the crosshead goes there once the specimen is prepared");
  run_start_ += (clock_now() - now_).toSec();
  now_ = clock_now();
  program_->lead({asked.extension, asked.load, asked.speed});
  begin_pace();
}

void UtmNode::on_move_cancelled(const Moves::GoalHandle& goal) {
  if (move_ && *move_ == goal && !program_->stand()) finish_move(EndedBy::kOperator);
}

void UtmNode::report_to_move() {
  if (!move_) return;
  MoveFeedback feedback;
  feedback.time = test_.sample.time;
  feedback.extension = test_.sample.extension;
  feedback.load = test_.sample.load;
  feedback.force = test_.sample.force_upper;
  move_->publishFeedback(feedback);
}

void UtmNode::finish_move(EndedBy by) {
  if (!move_) return;
  MoveResult result;
  result.ended_by = ended_by_name(by);
  result.time = test_.sample.time;
  result.extension = test_.sample.extension;
  result.load = test_.sample.load;
  stands_since_ = Clock::now();
  if (program_->ended()) {
    move_->setAborted(result, "the test ended by " + result.ended_by);
  } else if (by == EndedBy::kOperator) {
    move_->setCanceled(result, "the crosshead stands");
  } else {
    move_->setSucceeded(result, "the crosshead stands at its " + result.ended_by);
  }
  move_.reset();
}

}  // namespace knot_utm
