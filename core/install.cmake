# For `cmake --install` and find_package(chainmail): installs the public headers, the library as chainmail::chainmail, and
# the program that reads the formats of other libraries.

# The public interface: these headers, by room. Each includes only others of this list, Eigen and the standard library.
set(public_headers
  chainmail.h
  body/blade.h
  body/body.h
  body/handle.h
  body/method.h
  body/positions.h
  body/region.h
  body/region_axes.h
  body/snapshot.h
  body/softness.h
  calibrate/calibrate.h
  elastic/elastic.h
  elastic/material.h
  elastic/small.h
  equilibrium/equilibrium_solver.h
  equilibrium/link_energy.h
  equilibrium/relaxation.h
  equilibrium/relaxation_scheme.h
  files/formats/imported.h
  files/formats/mesh_state.h
  files/formats/read_options.h
  files/formats/space.h
  files/formats/volume.h
  files/formats/voxel_block.h
  files/mesh/flaws.h
  files/mesh/mesh_arrays.h
  files/mesh/mesh_file.h
  files/mesh/mesh_formats.h
  files/mesh/open_mesh.h
  files/results/results_json.h
  files/session/flat_mesh.h
  files/session/softness_presets.h
  files/text/limits.h
  measure/converging_reference.h
  measure/distance.h
  measure/pass_times.h
  measure/physical_error.h
  measure/reference_solution.h
  measure/violation.h
  mesh/cells.h
  mesh/cuts.h
  mesh/described.h
  mesh/element_blocks.h
  mesh/error.h
  mesh/fixed_matrix.h
  mesh/generate.h
  mesh/large_pages.h
  mesh/layers.h
  mesh/link_shares.h
  mesh/mesh.h
  mesh/parameters.h
  mesh/progress.h
  mesh/row_kinds.h
  mesh/split.h
  mesh/surface.h
  mesh/texture.h
  report/page/report.h
  report/page/plot.h
  report/run/cases.h
  report/run/clocks.h
  report/run/compare.h
  report/run/contest.h
  report/run/drags.h
  report/run/physics.h
  report/run/preparing.h
  report/run/ramp.h
  report/run/runner.h
  report/table/contestant.h
  report/table/figure.h
  report/table/growth.h
  report/table/machine.h
  report/table/results.h
  report/table/summary.h
  simulate/command.h
  simulate/simulation.h
  simulate/simulation_state.h
  solver/algorithms.h
  solver/custom_method.h
  solver/deformer.h)
# Headers of parts that are left out.
if(NOT CHAINMAIL_JSON)
  list(FILTER public_headers EXCLUDE REGEX "^files/(results|session)/")
endif()
if(NOT CHAINMAIL_CALIBRATE)
  list(FILTER public_headers EXCLUDE REGEX "^calibrate/")
endif()

include(CMakePackageConfigHelpers)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/chainmail)

set(parts chainmail_core chainmail_mesh_files)
if(CHAINMAIL_JSON)
  list(APPEND parts chainmail_files)
endif()
if(CHAINMAIL_CALIBRATE)
  list(APPEND parts chainmail_calibrate)
endif()
# Public headers include each other by their rooms, and programs include them as chainmail/ROOM/NAME.h.
add_library(chainmail_library INTERFACE)
set_target_properties(chainmail_library PROPERTIES EXPORT_NAME chainmail)
target_include_directories(chainmail_library INTERFACE
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/chainmail>)
# Tells the headers where chainmail-import is.
target_compile_definitions(chainmail_library INTERFACE
  $<INSTALL_INTERFACE:CHAINMAIL_IMPORT_PROGRAM="$<INSTALL_PREFIX>/${CMAKE_INSTALL_LIBEXECDIR}/chainmail/chainmail-import">)
target_link_libraries(chainmail_library INTERFACE ${parts})
set(installed chainmail_library ${parts})
install(TARGETS ${installed} EXPORT chainmail
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT core
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT core)
foreach(header IN LISTS public_headers)
  cmake_path(GET header PARENT_PATH room)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/chainmail/${room} COMPONENT core)
endforeach()

install(EXPORT chainmail NAMESPACE chainmail:: FILE chainmail-targets.cmake
  DESTINATION ${config_folder} COMPONENT core)
configure_package_config_file(chainmail-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/chainmail-config.cmake
  INSTALL_DESTINATION ${config_folder})
# By semantic versioning, a new minor version adds to the interface, and a new major version may change it.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/chainmail-config-version.cmake
  VERSION ${PROJECT_VERSION} COMPATIBILITY SameMajorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/chainmail-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/chainmail-config-version.cmake
  DESTINATION ${config_folder} COMPONENT core)

# Makes the documentation of the public headers in the folder docs of the build, with warnings as errors.
list(JOIN public_headers " " documented)
add_custom_target(docs VERBATIM COMMAND ${CMAKE_COMMAND} -DCORE=${CMAKE_CURRENT_SOURCE_DIR}
  -DHEADERS=${documented} -DOUT=${CMAKE_BINARY_DIR}/docs -DVERSION=${PROJECT_VERSION}
  -P ${CMAKE_CURRENT_SOURCE_DIR}/docs/docs.cmake)
set_property(GLOBAL PROPERTY chainmail_public_headers ${documented})
