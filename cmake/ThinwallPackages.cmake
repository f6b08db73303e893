# Debian packages:  cmake --preset package && cmake --build --preset package
#   thinwall            the program
#   libthinwall0.1      the shared library; the name follows the version of its interface
#   libthinwall-dev     headers, find_package(thinwall), pkg-config thinwall
#   thinwall-mpi        the ranks of `thinwall run --ranks`, if they are built
#   python3-thinwall    the Python module, if it is built
# The packages are for every machine of an architecture; the version of packages built with THINWALL_NATIVE, which run on
# this processor only, ends with "+native". dpkg-shlibdeps finds their dependencies.
set(THINWALL_MAINTAINER "The maintainers of thinwall <maintainers@thinwall.example>" CACHE STRING "Of the packages")
set(THINWALL_PACKAGE_VERSION ${PROJECT_VERSION})
if(THINWALL_NATIVE)
  string(APPEND THINWALL_PACKAGE_VERSION "+native")
endif()
set(thinwall_library_package libthinwall${thinwall_version_of_interface})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME thinwall)
set(CPACK_PACKAGE_CONTACT "${THINWALL_MAINTAINER}")
set(CPACK_PACKAGE_VERSION ${THINWALL_PACKAGE_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_COMPONENTS_ALL runtime library dev)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)

# thinwall_package(<component> <name> <section> <summary>, a line of words)   makes a package with copyright and changes
function(thinwall_package component name section summary)
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${summary}
Finite elements, substructuring and stability lobes for the milling of
thin-walled parts, alone or backed by a robot." PARENT_SCOPE)
  install(FILES ${PROJECT_BINARY_DIR}/copyright ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION share/doc/${name}
          COMPONENT ${component})
endfunction()

# The licences of the packages from which the page of results is built, as the text of a control field: each line begins
# with a blank, and an empty line is " .".
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS web/dist/LICENSES.txt)
file(READ web/dist/LICENSES.txt THINWALL_PAGE_LICENSES)
string(STRIP "${THINWALL_PAGE_LICENSES}" THINWALL_PAGE_LICENSES)
string(REPLACE "\n" "\n " THINWALL_PAGE_LICENSES " ${THINWALL_PAGE_LICENSES}")
string(REPLACE "\n \n" "\n .\n" THINWALL_PAGE_LICENSES "${THINWALL_PAGE_LICENSES}")
configure_file(packaging/copyright.in ${PROJECT_BINARY_DIR}/copyright @ONLY)

execute_process(COMMAND date -R -r ${PROJECT_SOURCE_DIR}/CHANGELOG.md OUTPUT_VARIABLE THINWALL_PACKAGE_DATE
                OUTPUT_STRIP_TRAILING_WHITESPACE)
configure_file(packaging/changelog.in ${PROJECT_BINARY_DIR}/changelog @ONLY)
execute_process(COMMAND gzip -9nkf ${PROJECT_BINARY_DIR}/changelog)

thinwall_package(runtime thinwall science "vibration and chatter of thin-walled parts in milling")
thinwall_package(library ${thinwall_library_package} libs "vibration and chatter of thin-walled parts - library")
file(WRITE ${PROJECT_BINARY_DIR}/package_library/triggers "activate-noawait ldconfig\n")
file(WRITE ${PROJECT_BINARY_DIR}/package_library/shlibs
     "libthinwall ${thinwall_version_of_interface} ${thinwall_library_package} (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/package_library/triggers
                                               ${PROJECT_BINARY_DIR}/package_library/shlibs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)
file(WRITE ${PROJECT_BINARY_DIR}/package_library/overrides
     "# CPack adds scripts that call ldconfig, whatever the trigger does.\n${thinwall_library_package}: maintscript-calls-ldconfig *\n")
install(FILES ${PROJECT_BINARY_DIR}/package_library/overrides DESTINATION share/lintian/overrides
        RENAME ${thinwall_library_package} COMPONENT library)
thinwall_package(dev libthinwall-dev libdevel "vibration and chatter of thin-walled parts - headers")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${thinwall_library_package} (= ${THINWALL_PACKAGE_VERSION}), libeigen3-dev (>= 3.4)")
if(TARGET thinwall_mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
  thinwall_package(mpi thinwall-mpi science "vibration and chatter of thin-walled parts - MPI")
  set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "thinwall (= ${THINWALL_PACKAGE_VERSION}), openmpi-bin")
endif()
if(TARGET thinwall_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  thinwall_package(python python3-thinwall python "vibration and chatter of thin-walled parts - Python")
  math(EXPR next "${THINWALL_PYTHON_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${THINWALL_PYTHON_MINOR}), python3 (<< 3.${next}), python3-numpy, python3-scipy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-matplotlib)
endif()

# The target packs the program and the library, which it builds first, but not the tests.
add_custom_target(packages COMMAND ${CMAKE_CPACK_COMMAND} DEPENDS thinwall thinwall_shared USES_TERMINAL)
if(TARGET thinwall_mpi)
  add_dependencies(packages thinwall_mpi)
endif()
if(TARGET thinwall_python)
  add_dependencies(packages thinwall_python)
endif()
include(CPack)
