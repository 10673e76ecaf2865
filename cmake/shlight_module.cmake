# shlight_module(name
#     SOURCES …      x.cpp
#     HEADERS …      x.h, installed
#     PUBLIC …       targets that the headers need
#     PRIVATE …      targets that only the sources need
#     TESTS …        x_test.cpp, one program for the folder
#     GL_TESTS …     x_gl_test.cpp, a program of their own: they need a graphics context
#     BENCHMARKS …   x_bench.cpp, one program for the folder
#     TEST_LIBRARIES …  more targets for tests and benchmarks)
#
# One folder is one library, shlight::<name>.
function(shlight_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;HEADERS;PUBLIC;PRIVATE;TESTS;GL_TESTS;BENCHMARKS;TEST_LIBRARIES" ${ARGN})
  set(target shlight_${name})
  add_library(${target} STATIC ${arg_SOURCES} ${arg_HEADERS})
  add_library(shlight::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  # How this library is compiled, which is nothing that the installed one has to say to others.
  set_property(TARGET ${target} APPEND PROPERTY LINK_LIBRARIES shlight_options)
  set_property(GLOBAL APPEND PROPERTY SHLIGHT_MODULES ${name})
  install(FILES ${arg_HEADERS} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/shlight/${name})

  if(SHLIGHT_WITH_TESTS AND arg_TESTS)
    add_executable(${name}_test ${arg_TESTS})
    target_link_libraries(${name}_test PRIVATE shlight::${name} ${arg_TEST_LIBRARIES} GTest::gtest GTest::gtest_main
                                               shlight_options)
    add_test(NAME ${name} COMMAND ${name}_test)
  endif()
  if(SHLIGHT_WITH_TESTS AND arg_GL_TESTS)
    add_executable(${name}_gl_test ${arg_GL_TESTS})
    target_link_libraries(${name}_gl_test PRIVATE shlight::${name} ${arg_TEST_LIBRARIES} GTest::gtest
                                                  GTest::gtest_main shlight_options)
    add_test(NAME ${name}_gl COMMAND ${name}_gl_test)
  endif()
  if(SHLIGHT_WITH_BENCHMARKS AND arg_BENCHMARKS)
    add_executable(${name}_bench ${arg_BENCHMARKS})
    target_link_libraries(${name}_bench PRIVATE shlight::${name} ${arg_TEST_LIBRARIES} benchmark::benchmark
                                                benchmark::benchmark_main shlight_options)
    if(SHLIGHT_WITH_TESTS)
      # That a benchmark still starts is tested; how long it takes is not, on machines that nobody knows.
      add_test(NAME ${name}_bench_starts COMMAND ${name}_bench --benchmark_list_tests)
    endif()
  endif()
endfunction()
