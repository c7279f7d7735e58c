#pragma once

#include <string>

namespace knot_utm {

/// All code that this process computes with: the build ids of the program and of every library that it has loaded, and
/// what the library of mathematics chooses its functions by. The linker makes a build id of the whole content of a
/// file, so code that is compiled from other sources, or in another way, has another one. Two processes with the same
/// text make the same bits. Empty where a library has no build id, because then nothing is known of it.
const std::string& build_identity();

}  // namespace knot_utm
