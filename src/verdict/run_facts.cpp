#include "knot_utm/verdict/run_facts.hpp"

#include <sys/resource.h>

namespace knot_utm {

std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  // Linux counts in KiB.
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024u;
}

std::string version() { return KNOT_UTM_VERSION; }

}  // namespace knot_utm
