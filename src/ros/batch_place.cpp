#include "knot_utm/ros/batch_place.hpp"

#include "knot_utm/io/command_hint.hpp"

namespace knot_utm {

std::string BatchPlace::text() const { return "specimen " + std::to_string(number) + " of " + std::to_string(count); }

Method method_of_batch(const Method& method, int count) {
  Method out = method;
  out.specimens.count = count;
  return out;
}

std::string command_to_resume(const std::string& batch) {
  return command_line({program_beside("tensile_test"), "--resume", batch});
}

}  // namespace knot_utm
