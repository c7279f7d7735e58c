#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

/// A fuzz target gives any bytes to one parser, and holds what comes out against what it promises. The parser's
/// InvalidInput may leave it and nothing else may. A source in test/fuzz has for each of its targets a line
///
///     const FuzzTarget method("method", fuzz_method);
///
/// from which scripts/fuzz and the build take its name. Its seeds, and inputs that once failed, are in the folder of
/// that name in test/fuzz/inputs.tar.xz.
struct FuzzTarget {
  using Fuzz = void (*)(const std::string& text);

  FuzzTarget(const std::string& name, Fuzz fuzz);
};

/// A promise of the parser. Broken, it ends the process, which libFuzzer takes for a crash and ctest for a failure.
inline void promise(bool kept, const char* what) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

/// Whether a parser understands what it is given; if not, that it says so as it should.
template <typename Parse>
bool understood(Parse parse) {
  try {
    parse();
    return true;
  } catch (const InvalidInput& refused) {
    const std::string line = refused.what();
    promise(line.find('\n') == std::string::npos, "a refusal is one line");
    promise(line.size() < 4096, "a refusal can be read");
    promise(!refused.key.empty(), "a refusal says where");
    return false;
  }
}

}  // namespace knot_utm
