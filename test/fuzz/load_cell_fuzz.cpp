// A load cell's file.
#include "fuzz/memory_file.hpp"
#include "fuzz/target.hpp"
#include "knot_utm/io/method.hpp"

namespace knot_utm {

void fuzz(const std::string& text) {
  const MemoryFile file(text);
  const Method method = parse_method(
      "{material: nylon, machine: {load_cell: " + file.name() + "}, program: [{hold: {duration: 1}}]}", "fuzz.yaml");
  const LoadCellOptions& cell = method.machine.load_cell;
  promise(cell.capacity > 0.0 && cell.resolution < cell.capacity, "a resolution below the capacity");
  promise(cell.sampling_rate >= 1e-2 && cell.sampling_rate <= 1e4, "a sampling rate in its range");
  promise(!cell.name.empty(), "a load cell has a name");
}

}  // namespace knot_utm
