# Flags every target of the package shares.
add_library(knot_utm_compiler INTERFACE)

# x86-64-v3 (AVX2, FMA) is worth a factor 1.5 to 2 in the solver; taken where the building machine runs it.
# EIGEN_MAX_ALIGN_BYTES keeps the memory layout of fixed-size Eigen members the same as without it.
include(CheckCXXSourceRuns)
set(CMAKE_REQUIRED_FLAGS "-O2 -march=x86-64-v3")
check_cxx_source_runs("
#include <immintrin.h>
int main() {
  volatile double one = 1.0;
  __m256d a = _mm256_set1_pd(one);
  double out[4];
  _mm256_storeu_pd(out, _mm256_fmadd_pd(a, a, a));
  return out[3] == 2.0 ? 0 : 1;
}" KNOT_UTM_HOST_HAS_X86_64_V3)
unset(CMAKE_REQUIRED_FLAGS)
option(KNOT_UTM_X86_64_V3 "Use AVX2 and FMA" ${KNOT_UTM_HOST_HAS_X86_64_V3})
# What links the installed library takes it too: of the inline functions of Eigen that both have compiled, the linker keeps
# either one, and readings would depend on which.
if(KNOT_UTM_X86_64_V3)
  target_compile_options(knot_utm_compiler INTERFACE -march=x86-64-v3)
endif()
target_compile_definitions(knot_utm_compiler INTERFACE EIGEN_MAX_ALIGN_BYTES=16)

set(warnings -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(KNOT_UTM_WERROR)
  list(APPEND warnings -Werror)
endif()
target_compile_options(knot_utm_compiler INTERFACE "$<BUILD_INTERFACE:${warnings}>")

# The options of a build under sanitizers. GCC 12 warns falsely there of what may not be initialised.
set(sanitizer_options -fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=all)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  list(APPEND sanitizer_options -Wno-maybe-uninitialized)
endif()

# As a shared library too, the core may inline its own exported functions.
target_compile_options(knot_utm_compiler INTERFACE $<BUILD_INTERFACE:-fno-semantic-interposition>)

# Headers that all of some targets read are compiled once: knot_utm_precompile("TARGET..." HEADER...)
function(knot_utm_precompile targets)
  list(POP_FRONT targets first)
  if(first)
    target_precompile_headers(${first} PRIVATE ${ARGN})
  endif()
  foreach(target ${targets})
    target_precompile_headers(${target} REUSE_FROM ${first})
  endforeach()
endfunction()
