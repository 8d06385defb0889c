# For `cmake --install` and find_package(chainmail): installs the public headers, the library as chainmail::chainmail, and
# the program that reads the formats of other libraries. The other libraries are parts that chainmail::chainmail links;
# they have no headers.
include(CMakePackageConfigHelpers)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/chainmail)

set(installed chainmail_api chainmail_core chainmail_mesh_files)
if(CHAINMAIL_JSON)
  list(APPEND installed chainmail_files)
endif()
if(CHAINMAIL_CALIBRATE)
  list(APPEND installed chainmail_calibrate)
endif()
install(TARGETS ${installed} EXPORT chainmail
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT core
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT core)
install(DIRECTORY api/chainmail DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT core FILES_MATCHING PATTERN "*.h")

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
