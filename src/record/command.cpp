#include "knot_utm/record/command.hpp"

#include "knot_utm/record/sample_fields.hpp"

namespace knot_utm {

// In the order of a checkpoint: another one is another version of it.
void Command::state(Archive& archive) {
  archive(sequence, time, displacement, velocity, step);
  archive.choice("phase", phase, last_of(phase));
  archive(speed, duration, balance, read_cell);
}

}  // namespace knot_utm
