#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace knot_utm {

/// A fuzz target is one file, test/fuzz/NAME_fuzz.cpp, that defines this function: gives any bytes to one parser, and
/// holds what comes out against what it promises. The parser's InvalidInput may leave it and nothing else may.
/// Its seeds stand in test/fuzz/corpus/NAME/, inputs that once failed in test/fuzz/regressions/NAME/.
void fuzz(const std::string& text);

/// A promise of the parser. Broken, it ends the process, which libFuzzer takes for a crash and ctest for a failure.
inline void promise(bool kept, const char* what) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

}  // namespace knot_utm
