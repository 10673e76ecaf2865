# Third-party libraries, all from Debian 12. Each stays private to the folder named beside it.

find_package(fmt REQUIRED)            # core
find_package(TBB REQUIRED)            # core
find_package(OpenImageIO REQUIRED)    # image
find_package(muparser REQUIRED)       # light
find_package(nlohmann_json REQUIRED)  # light, transfer, apps
find_package(assimp REQUIRED)         # scene; its target names libz.so, which its package does not bring: zlib1g-dev
find_package(meshoptimizer REQUIRED)  # scene
find_package(embree 3 REQUIRED)       # transfer
find_package(glm REQUIRED)            # render
find_package(PkgConfig REQUIRED)
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)  # render
pkg_check_modules(egl REQUIRED IMPORTED_TARGET egl)      # render
if(SHLIGHT_WITH_APPS)
  find_package(CLI11 REQUIRED)
  find_package(spdlog REQUIRED)
  pkg_check_modules(glfw REQUIRED IMPORTED_TARGET glfw3)   # viewer
  pkg_check_modules(imgui REQUIRED IMPORTED_TARGET imgui)  # viewer
endif()
if(SHLIGHT_WITH_TESTS)
  find_package(GTest REQUIRED)
endif()
if(SHLIGHT_WITH_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()

# Debian's OpenImageIO target names /usr/include/opencv4, which its package does not bring.
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "")
