# Whether the machine that builds can run AVX2.
include(CheckCXXSourceRuns)
set(RINGCRAFT_HAS_AVX2 OFF)
if(NOT CMAKE_CROSSCOMPILING)
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") ? 0 : 1; }"
    RINGCRAFT_RUNS_AVX2)
  if(RINGCRAFT_RUNS_AVX2)
    set(RINGCRAFT_HAS_AVX2 ON)
  endif()
endif()
