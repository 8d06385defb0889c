# Packages for Debian: `cmake --build build/package --target package`. Each is the components of one kind of user.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME chainmail)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The ChainMail workbench authors <authors@chainmail.invalid>")
# The first line of all descriptions.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "deformable models of the ChainMail family")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/reproducible.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/finish_tree.cmake)

set(CPACK_COMPONENTS_ALL window command_line core)
if(CHAINMAIL_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS OFF)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME chainmail)
# A window needs a driver for OpenGL and a font, which the libraries of Qt do not name.
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "libgl1-mesa-dri, fonts-dejavu-core | fonts-freefont-ttf")
set(CPACK_DEBIAN_PROGRAMS_DESCRIPTION "Drag soft objects, and measure how fast and how wrong each algorithm is: a
window with algorithms side by side, and a command line. With samples, lessons
and the manual.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libchainmail-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "chainmail (= ${PROJECT_VERSION}), libnlopt-dev, zlib1g-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "The solvers as a C++ library: headers, the static library and a
configuration for CMake.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-chainmail)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "chainmail (= ${PROJECT_VERSION}), python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
# They compile the Python files, and remove what Python has compiled.
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  ${CMAKE_CURRENT_LIST_DIR}/python/postinst ${CMAKE_CURRENT_LIST_DIR}/python/prerm)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-distributed, python3-pandas")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "The solvers for Python: meshes from files and arrays, drags, comparisons and
parameter studies.")

include(CPack)
cpack_add_component_group(programs)
cpack_add_component(window GROUP programs)
cpack_add_component(command_line GROUP programs)
cpack_add_component_group(development)
cpack_add_component(core GROUP development)
if(CHAINMAIL_PYTHON)
  cpack_add_component_group(python)
  cpack_add_component(python GROUP python)
endif()
