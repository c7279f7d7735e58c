#include "knot_utm/analysis/elongations.hpp"

namespace knot_utm {

Elongations elongations(double gauge_length, double loaded_length, double unloaded_length) {
  const double back = loaded_length - unloaded_length;
  return {(loaded_length - gauge_length) / gauge_length, (unloaded_length - gauge_length) / gauge_length,
          back / gauge_length, back / unloaded_length};
}

}  // namespace knot_utm
