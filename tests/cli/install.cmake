# Installs a build into an empty folder. Then builds and runs a user's program with the installed library.
#   cmake -DBUILD=… -DCONSUMER=… -DCONFIG=… -DFLAGS=… -DCOMPILER=… -DGENERATOR=… -P install.cmake
set(prefix ${BUILD}/tests/install/prefix)
set(work ${BUILD}/tests/install/consumer)
file(REMOVE_RECURSE ${prefix} ${work})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Leaves out the window, which this test does not need.
foreach(component IN ITEMS core command_line)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} --component ${component})
endforeach()
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${work} -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${prefix}
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=${CONFIG})
run(${CMAKE_COMMAND} --build ${work})
run(${work}/consumer)
run(${prefix}/bin/chainmail --version)
