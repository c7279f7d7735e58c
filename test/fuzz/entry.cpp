// What libFuzzer and replay.cpp call with every input.
#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/target.hpp"
#include "knot_utm/rod/invalid_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    knot_utm::fuzz(std::string(data, data + size));
  } catch (const knot_utm::InvalidInput& refused) {
    const std::string line = refused.what();
    knot_utm::promise(line.find('\n') == std::string::npos, "a refusal is one line");
    knot_utm::promise(line.size() < 4096, "a refusal can be read");
    knot_utm::promise(!refused.key.empty() && !refused.allowed.empty(), "a refusal says where, and what is allowed");
  }
  return 0;
}
