# For `cmake --install` and find_package(chainmail): installs only the solver library, as chainmail::core, without file
# formats and the window.
include(CMakePackageConfigHelpers)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/chainmail)

install(TARGETS chainmail_core EXPORT chainmail
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT core
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT core)
foreach(room IN ITEMS mesh elastic solve measure simulate report)
  install(DIRECTORY ${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/chainmail COMPONENT core
    FILES_MATCHING PATTERN "*.h")
endforeach()

install(EXPORT chainmail NAMESPACE chainmail:: FILE chainmail-targets.cmake
  DESTINATION ${config_folder} COMPONENT core)
configure_package_config_file(chainmail-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/chainmail-config.cmake
  INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/chainmail-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/chainmail-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/chainmail-config-version.cmake
  DESTINATION ${config_folder} COMPONENT core)
