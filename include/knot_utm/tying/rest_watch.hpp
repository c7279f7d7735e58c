#pragma once

#include <string>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Waits for a specimen to come to rest: every node slower than a speed, for a while. Where rest does not come in time,
/// as where a knot creeps open, it is waited for no longer, and `not_equilibrated` says so.
class RestWatch {
 public:
  struct Options {
    double speed = 0.0;      ///< every node slower than this ... [m/s]
    double duration = 0.3;   ///< ... for this long: at rest [s]
    double patience = 60.0;  ///< without rest for this long it is waited for no longer [s]
  };
  explicit RestWatch(const Options& options) : options_(options) {}

  /// From now on it has not rested yet.
  void begin() { rested_ = 0.0; }
  /// Follows an accepted step of length `dt` [s].
  void follow(const Points& velocity, double dt);
  /// Whether everything is at rest, or rest has been waited for long enough by `time`, since `begin` [s], when what
  /// `since` says happened.
  bool waited(double time, double begin, const char* since);

  double patience() const { return options_.patience; }
  /// What had not come to rest; empty: nothing.
  const std::string& not_equilibrated() const { return not_equilibrated_; }
  void forget() { not_equilibrated_.clear(); }

  void state(Archive& archive) { archive(rested_, fastest_, not_equilibrated_); }

 private:
  Options options_;
  double rested_ = 0.0, fastest_ = 0.0;  // [s], [m/s]
  std::string not_equilibrated_;
};

}  // namespace knot_utm
