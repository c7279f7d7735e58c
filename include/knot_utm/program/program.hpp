#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/ended_by.hpp"
#include "knot_utm/words/fields.hpp"

namespace knot_utm {

class CrossheadCourse;
class ProgramStep;
struct Sample;

using Program = std::vector<ProgramStep>;

/// Highest speed of a crosshead or a tail grip that a method may ask for, as of testing machines [m/s].
inline constexpr double kFastestCrosshead = 0.5;

/// Where a step stands, for its checks.
struct StepPlace {
  const Program& program;
  std::size_t index = 0;
  std::string loops;        ///< the knots that are loops, as a message lists them; empty: the specimen is one
  std::string can_be_tied;  ///< the knots that can be tied, likewise; empty: the specimen can
  bool turns = true;        ///< its upper grip is a clamp that can be turned

  std::string key() const;  ///< "program.4.pull"
  /// Throws InvalidInput: the step cannot stand where it stands.
  [[noreturn]] void misplaced(const std::string& why) const;
  /// Throws InvalidInput unless `knots` is empty: the step needs a specimen that is one of them.
  void needs(const std::string& knots) const;
};

/// A step of a test program: its keys in a method, how it moves the crosshead, and when it ends. A kind of step is a
/// pair of files and one line in program.cpp. Steps are copied with their program; `begin` resets what a step remembers
/// while it runs.
class Step {
 public:
  enum Trait : unsigned {
    kPrepares = 1,      ///< the specimen is made, mounted and zeroed, before the test proper
    kForms = 2,         ///< the specimen is being tied, or let go once it is tied
    kEndsByItself = 4,  ///< the machine says when it is done; other steps end at a condition of the program
    kRests = 8,         ///< a loop that was released stays off the rollers, and without its weight
    kMoves = 16,        ///< the crosshead moves
    kLoads = 32,        ///< it puts a load on the specimen
    kPulls = 64,        ///< the specimen may be pulled further than before: these samples make the curve
    kCanBreak = 128     ///< a load that falls during it may be a break
  };

  virtual ~Step() = default;

  double speed = 0.0033;  ///< of the crosshead; where a load is asked for, the highest [m/s]; tie: of the tail grips
  double duration = 0.0;  ///< release: ramp and rest; hold: how long [s]

  const char* name() const { return name_; }  ///< in methods, messages and curve files
  unsigned traits() const { return traits_; }
  const char* ends_when() const { return ends_; }  ///< for the page of the keys
  Phase phase() const { return phase_named(name_).value_or(Phase::kIdle); }

  /// Its keys in a method. `usual_extension`: that which the knot's pull has by default [m].
  virtual void keys(fields::Fields&, double /*usual_extension*/) {}
  /// Throws InvalidInput where it cannot stand at its place, or its keys do not go together.
  virtual void check(const StepPlace&) const {}
  /// Whether it puts a load on the specimen.
  virtual bool loads() const { return (traits_ & kLoads) != 0; }

  /// `now` is the last sample before its first command. The crosshead stands until the step moves it.
  virtual void begin(const Sample& /*now*/, CrossheadCourse&) {}
  /// Before each of its commands.
  virtual void steer(const Sample& /*now*/, CrossheadCourse&) {}
  /// After each of its commands; kNotYet: it goes on. Unless a step says otherwise it ends when its time is over.
  virtual EndedBy ended(const Sample& now, CrossheadCourse& course);
  /// How long it takes, estimated where it does not end by time [s].
  virtual double usual_duration(const CrossheadCourse&) const { return duration; }

 protected:
  static constexpr fields::Range kSpeeds{1e-7, kFastestCrosshead, "m/s"};
  static constexpr fields::Range kLoadRates{1e-6, 1e8, "N/s"};
  static constexpr double kUsualDistance = 0.01;  ///< that stands for one which only the specimen knows [m]

  Step(const char* name, unsigned traits, const char* ends) : name_(name), traits_(traits), ends_(ends) {}
  void speed_key(fields::Fields& f) { f.says("speed", "1.04 radii/s").scaled_number("speed", speed, kSpeeds); }
  Step(const Step&) = default;
  Step& operator=(const Step&) = default;

 private:
  const char* name_;
  unsigned traits_;
  const char* ends_;
};

/// A step of any kind, as a value.
class ProgramStep {
 public:
  template <class Own, class = std::enable_if_t<std::is_base_of_v<Step, Own>>>
  ProgramStep(Own step)
      : step_(std::make_unique<Own>(std::move(step))), copy_([](const Step& other) -> std::unique_ptr<Step> {
          return std::make_unique<Own>(static_cast<const Own&>(other));
        }) {}
  ProgramStep(const ProgramStep& other) : step_(other.copy_(*other.step_)), copy_(other.copy_) {}
  ProgramStep(ProgramStep&&) noexcept = default;
  ProgramStep& operator=(ProgramStep other) noexcept {
    std::swap(step_, other.step_);
    std::swap(copy_, other.copy_);
    return *this;
  }
  ~ProgramStep() = default;

  Step* operator->() const { return step_.get(); }

  /// The step where it is of this kind, else null.
  template <class Own>
  Own* as() const {
    return dynamic_cast<Own*>(step_.get());
  }

 private:
  std::unique_ptr<Step> step_;
  std::unique_ptr<Step> (*copy_)(const Step&);
};

/// One step of every kind, with its defaults, in the order of their phases.
const Program& all_steps();
std::vector<std::string> step_names();
std::optional<ProgramStep> step_named(const std::string& name);

/// Whether the program has a step of this kind.
template <class Own>
bool has_step(const Program& program) {
  for (const ProgramStep& step : program)
    if (step.as<Own>()) return true;
  return false;
}

/// Index of the step with a number from 0, or with a name that only one step has ("pull"); empty: no step is meant.
std::optional<int> step_called(const Program& program, const std::string& name);

}  // namespace knot_utm
