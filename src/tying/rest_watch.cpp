#include "knot_utm/tying/rest_watch.hpp"

#include <cmath>
#include <sstream>

namespace knot_utm {

void RestWatch::follow(const Points& velocity, double dt) {
  fastest_ = std::sqrt(velocity.colwise().squaredNorm().maxCoeff());
  rested_ = fastest_ > options_.speed ? 0.0 : rested_ + dt;
}

bool RestWatch::waited(double time, double begin, const char* since) {
  if (rested_ >= options_.duration) return true;
  if (time - begin <= options_.patience) return false;
  std::ostringstream message;
  message << "not equilibrated: " << options_.patience << " s after " << since << ", the fastest node still moved at "
          << fastest_ << " m/s; at rest it moves at less than " << options_.speed << " m/s";
  not_equilibrated_ = message.str();
  return true;
}

}  // namespace knot_utm
