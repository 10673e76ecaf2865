# How every target is compiled.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

# -O3, not CMake's -O2: the spherical-harmonic kernels are plain loops that only -O3 vectorises.
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
# Dev is as fast as Release but keeps assertions and line numbers.
set(CMAKE_CXX_FLAGS_DEV "-O2 -g1")
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Dev, Release, Debug, RelWithDebInfo" FORCE)
endif()

# A second build of the same sources costs next to nothing where ccache is installed.
find_program(SHLIGHT_CCACHE ccache)
if(SHLIGHT_CCACHE AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${SHLIGHT_CCACHE})
endif()

add_library(shlight_options INTERFACE)
target_compile_options(shlight_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                                 $<$<BOOL:${SHLIGHT_WERROR}>:-Werror>)
if(SHLIGHT_SANITIZE)
  add_compile_options(-fsanitize=${SHLIGHT_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${SHLIGHT_SANITIZE})
  # Functions that are cloned per processor are chosen before a sanitizer's runtime is up, and crash there.
  add_compile_definitions(SHLIGHT_SANITIZED=1)
endif()
