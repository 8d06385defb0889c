# Installs a build into an empty folder and checks what is there. Then builds a user's program and the examples with the
# installed package, and checks what they print.
#   cmake -DSOURCE=… -DBUILD=… -DCONFIG=… -DVERSION=… -DFLAGS=… -DCOMPILER=… -DGENERATOR=… -P install.cmake
cmake_minimum_required(VERSION 3.25)
set(prefix ${BUILD}/tests/install/prefix)
set(work ${BUILD}/tests/install/consumer)
file(REMOVE_RECURSE ${prefix} ${work})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Runs a program, which must print a text that matches.
function(run_and_find pattern)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ECHO_OUTPUT_VARIABLE COMMAND_ERROR_IS_FATAL ANY)
  if(NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "${ARGN} did not print '${pattern}'")
  endif()
endfunction()

# Leaves out the window, which this test does not need.
foreach(component IN ITEMS core command_line)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} --component ${component})
endforeach()

# The public headers include each other, Eigen and the standard library.
file(GLOB_RECURSE headers RELATIVE ${prefix}/include/chainmail ${prefix}/include/chainmail/*.h)
if(headers STREQUAL "")
  message(FATAL_ERROR "no header is installed")
endif()
foreach(header IN LISTS headers)
  file(STRINGS ${prefix}/include/chainmail/${header} includes REGEX "^ *# *include")
  foreach(include IN LISTS includes)
    string(REGEX REPLACE "^#include \"(.*)\"$" "\\1" own ${include})
    if(NOT include MATCHES "^#include <(Eigen/[A-Za-z]+|[a-z_/]+([.]h)?)>" AND NOT own IN_LIST headers)
      message(FATAL_ERROR "${header} includes what users do not have: ${include}")
    endif()
  endforeach()
endforeach()

# The schemas are made by the build.
if(NOT EXISTS ${prefix}/share/chainmail/schemas/report.schema.json)
  message(FATAL_ERROR "the JSON schemas are not installed")
endif()

# The package leads to nothing in the source or the build, and leaves options of floating point to users.
file(GLOB_RECURSE package ${prefix}/*.cmake)
foreach(file IN LISTS package)
  file(READ ${file} text)
  string(FIND "${text}" "${SOURCE}/core" of_source)
  string(FIND "${text}" "ffp-contract" option)
  if(NOT of_source EQUAL -1 OR NOT option EQUAL -1)
    message(FATAL_ERROR "${file} names the source or an option of floating point")
  endif()
endforeach()

# The version is that of the project. Another minor version does not fit.
file(GLOB_RECURSE version_file ${prefix}/chainmail-config-version.cmake)
function(check_version wanted major minor fits)
  set(PACKAGE_FIND_VERSION ${wanted})
  set(PACKAGE_FIND_VERSION_MAJOR ${major})
  set(PACKAGE_FIND_VERSION_MINOR ${minor})
  set(CMAKE_SIZEOF_VOID_P 8)
  include(${version_file})
  if(NOT PACKAGE_VERSION STREQUAL VERSION OR (PACKAGE_VERSION_COMPATIBLE AND NOT fits)
     OR (fits AND NOT PACKAGE_VERSION_COMPATIBLE))
    message(FATAL_ERROR "version ${PACKAGE_VERSION} of the package: asked for ${wanted}, which should fit: ${fits}")
  endif()
endfunction()
string(REPLACE "." ";" parts ${VERSION})
list(GET parts 0 major)
list(GET parts 1 minor)
math(EXPR next "${minor} + 1")
check_version(${major}.${minor} ${major} ${minor} TRUE)
check_version(${major}.${next} ${major} ${next} FALSE)

run(${CMAKE_COMMAND} -S ${SOURCE}/tests/cli/consumer -B ${work} -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${prefix}
  -DEXAMPLES=${SOURCE}/core/examples
  -DCMAKE_COMPILE_WARNING_AS_ERROR=ON
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=${CONFIG})
run(${CMAKE_COMMAND} --build ${work})
run_and_find("chainmail ${VERSION}: 8 moved" ${work}/consumer ${SOURCE}/meshes/organ.msh)
run_and_find("move 10: 240 elements followed.*largest violation [0-9.]+e-1[0-9] of"
  ${work}/drag ${SOURCE}/meshes/cloth.obj ${work}/dragged.obj)
# Needs chainmail-import, which is in another folder than the program.
run_and_find("2240 elements.*move 10: 458 elements" ${work}/drag ${SOURCE}/meshes/organ.msh)
run_and_find("Generalized ChainMail: [0-9.e-]+ ms per pass, largest violation 4[.]3266.*Exact ChainMail.* violation [0-9.]+e-0[67]"
  ${work}/compare ${work}/report)
run_and_find("before the cut, 199 elements.*after the cut, 99 elements.*the gap is 11[.]2 wide" ${work}/cut)
run_and_find("relative error 0[.]6[0-9]+ before, 0[.]2[0-9]+ after.*one drag: relative error 0[.][1-4]" ${work}/calibrate)
run_and_find("Rings: RMS distance to Exact ChainMail 0[.]36601.*Natural Queue.* 0[.]36601" ${work}/own_method)
foreach(written IN ITEMS dragged.obj report/report.html report/report.json)
  if(NOT EXISTS ${work}/${written})
    message(FATAL_ERROR "${written} was not written")
  endif()
endforeach()
run(${prefix}/bin/chainmail --version)

# What people cite has the version of the project.
file(STRINGS ${SOURCE}/CITATION.cff cited REGEX "^version: ${VERSION}$")
if(NOT cited)
  message(FATAL_ERROR "CITATION.cff does not have the version ${VERSION}")
endif()
