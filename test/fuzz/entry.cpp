// What libFuzzer and replay.cpp call with every input.
#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  knot_utm::understood([&] { knot_utm::fuzz(std::string(data, data + size)); });
  return 0;
}
