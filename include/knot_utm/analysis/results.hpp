#pragma once

#include <optional>

namespace knot_utm {

enum class MotionPattern { kNone, kSliding, kStretching, kUntangling };

/// "none", "sliding", "stretching", "untangling"
inline const char* motion_pattern_name(MotionPattern pattern) {
  constexpr const char* kNames[] = {"none", "sliding", "stretching", "untangling"};
  return kNames[static_cast<int>(pattern)];
}

/// What a curve and the shapes on the way mean.
struct Results {
  MotionPattern motion_pattern = MotionPattern::kNone;
  double motion_pattern_confidence = 0.0;  ///< 0..1
  std::optional<double> plateau_force;     ///< [N]
  std::optional<double> plateau_force_sd;  ///< [N]
  std::optional<double> lock_extension;    ///< [m]; unset: never locked
  std::optional<double> locked_stiffness;  ///< [N/m]
  double peak_force = 0.0;                 ///< [N]
  std::optional<double> break_extension;   ///< [m]; unset: not broken
  std::optional<double> untangled_at;      ///< [s]; unset: still tied
  bool knot_type_preserved = true;
};

}  // namespace knot_utm
