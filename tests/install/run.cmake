# cmake -DBUILD=… -DEXAMPLE=… -DWORK=… -DCOMPILER=… [-DLAUNCHER=…] [-DSANITIZE=…] -P run.cmake
#
# Installs the build into a folder of its own, then configures, builds and runs the example project against that alone.

# Nothing of an earlier run may help this one.
file(REMOVE_RECURSE ${WORK})

if(SANITIZE)
  set(flags -fsanitize=${SANITIZE})  # libraries built with a sanitizer need it in the program
endif()

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -G Ninja -S ${EXAMPLE} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} "-DCMAKE_CXX_FLAGS=${flags}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/golden_value)
run(${WORK}/build/project_light builtin:thesis ${WORK}/thesis.json)
run(${WORK}/build/draw_scene ${WORK}/scene.png)
if(EXISTS ${WORK}/prefix/bin/shlight)
  run(${WORK}/prefix/bin/shlight --help)
endif()
