# The language, the flags and the processor that everything in this project is compiled for.
include(CheckCXXSourceRuns)

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo" FORCE)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

# A wheel may travel to another machine, so it holds two builds: one for the architecture's baseline,
# and one for processors that have AVX2 and FMA. Any other build is for this machine.
set(default_arch "")
set(default_wide_arch "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  if(SKBUILD_STATE STREQUAL "wheel")
    set(default_wide_arch x86-64-v3)
  elseif(NOT CMAKE_CROSSCOMPILING)
    check_cxx_source_runs(
      "int main() { return !(__builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\") &&
                             __builtin_cpu_supports(\"bmi2\")); }"
      MLT_HOST_HAS_AVX2)
    if(MLT_HOST_HAS_AVX2)
      set(default_arch x86-64-v3)
    endif()
  endif()
endif()
set(PYMLT_ARCH "${default_arch}" CACHE STRING "Value of -march=; empty: the compiler's default")
set(PYMLT_WIDE_ARCH "${default_wide_arch}" CACHE STRING
    "Value of -march= of a second build in a wheel, for processors that have it; empty: none")
if(PYMLT_ARCH)
  add_compile_options(-march=${PYMLT_ARCH})
endif()

# Never -ffast-math: rays have an infinite end, and samples are tested for NaN.
add_compile_options(
  -Wall -Wextra -fno-math-errno -fno-trapping-math "$<$<CONFIG:Release,RelWithDebInfo>:-O3>"
  "$<$<CONFIG:Debug>:-O1>")

if(PYMLT_SANITIZE)
  set(sanitizers -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_compile_options(${sanitizers})
  add_link_options(${sanitizers})
endif()

if(PYMLT_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "PYMLT_FUZZ needs clang's libFuzzer: use `cmake --preset fuzz`, "
                        "after `apt-get install clang` and the libclang-rt-*-dev beside it.")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link -DFUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION)
endif()
