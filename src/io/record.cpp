#include "knot_utm/io/record.hpp"

namespace knot_utm {

void Record::state(Archive& archive) {
  archive(wall_time, command, answer);
  archive.list(steps);
  archive.list(shape);
  archive.list(tension);
}

}  // namespace knot_utm
