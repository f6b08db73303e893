# Installs the program, the library with its headers, and the files by which other builds find it (`cmake --install`).
#   runtime    bin/thinwall, its manual page and completions, the licence and the change log
#   library    lib/libthinwall.so.0.1
#   dev        include/thinwall, lib/libthinwall.so, find_package(thinwall), pkg-config thinwall
#   mpi        bin/thinwall-mpi, if it is built (distributed/CMakeLists.txt)
#   python     the module, if it is built (python/CMakeLists.txt)
# One shared library is installed, so that programs that link it need Eigen's headers and none of the libraries below it.
# The program and the Python module are linked statically from the same objects.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
if(CMAKE_LIBRARY_ARCHITECTURE AND CMAKE_INSTALL_LIBDIR STREQUAL lib)  # Debian's folder for the architecture, with any prefix
  set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE})
endif()

set(THINWALL_FOLDERS core linalg dynamics distributed mesh fem reduction robot coupling regression identification milling learning posture io setup case study)
set(thinwall_version_of_interface ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

# All objects of all folders; the archives beside them only state which other libraries they need.
list(TRANSFORM THINWALL_FOLDERS REPLACE "(.+)" "$<TARGET_OBJECTS:thinwall_\\1>" OUTPUT_VARIABLE thinwall_objects)
list(TRANSFORM THINWALL_FOLDERS PREPEND thinwall:: OUTPUT_VARIABLE thinwall_archives)
add_library(thinwall_shared SHARED ${thinwall_objects})
set_target_properties(thinwall_shared PROPERTIES OUTPUT_NAME thinwall EXPORT_NAME thinwall LINKER_LANGUAGE CXX
                                                 VERSION ${PROJECT_VERSION} SOVERSION ${thinwall_version_of_interface})
target_link_libraries(thinwall_shared PRIVATE ${thinwall_archives} thinwall_flags INTERFACE Eigen3::Eigen)
target_compile_definitions(thinwall_shared INTERFACE ${THINWALL_EIGEN_ALIGNMENT})
target_compile_features(thinwall_shared INTERFACE cxx_std_20)

include(cmake/ThinwallBuiltFirst.cmake)
thinwall_built_first(thinwall runtime)
install(TARGETS thinwall RUNTIME COMPONENT runtime)
if(TARGET thinwall_mpi)
  thinwall_built_first(thinwall_mpi mpi)
  install(TARGETS thinwall_mpi RUNTIME COMPONENT mpi)
  execute_process(COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/packaging/thinwall-mpi.1
                  OUTPUT_FILE ${PROJECT_BINARY_DIR}/thinwall-mpi.1.gz)
  install(FILES ${PROJECT_BINARY_DIR}/thinwall-mpi.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT mpi)
endif()
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)

# thinwall_prints(<file> <words>...)   installs below share/ the text that `thinwall <words>` prints at installation
function(thinwall_prints file)
  set(made ${PROJECT_BINARY_DIR}/printed/${file})
  get_filename_component(folder ${file} DIRECTORY)
  list(JOIN ARGN " " words)
  if(file MATCHES "\\.gz$")
    string(APPEND words " COMMAND gzip -9n")
  endif()
  install(CODE "file(MAKE_DIRECTORY \"${PROJECT_BINARY_DIR}/printed/${folder}\")
  execute_process(COMMAND \"$<TARGET_FILE:thinwall>\" ${words} OUTPUT_FILE \"${made}\" COMMAND_ERROR_IS_FATAL ANY)"
          COMPONENT runtime)
  install(FILES ${made} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder} COMPONENT runtime)
endfunction()
thinwall_prints(man/man1/thinwall.1.gz man)
thinwall_prints(bash-completion/completions/thinwall completion bash)
thinwall_prints(zsh/vendor-completions/_thinwall completion zsh)
thinwall_prints(fish/vendor_completions.d/thinwall.fish completion fish)

thinwall_built_first(thinwall_shared library)
thinwall_built_first(thinwall_shared dev)
install(TARGETS thinwall_shared EXPORT thinwall LIBRARY COMPONENT library NAMELINK_COMPONENT dev
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

install(CODE "set(THINWALL_SOURCE_DIR \"${PROJECT_SOURCE_DIR}\")
  set(THINWALL_BINARY_DIR \"${PROJECT_BINARY_DIR}\")
  set(THINWALL_FOLDERS \"${THINWALL_FOLDERS}\")
  set(THINWALL_INCLUDE_DIR \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}\")" COMPONENT dev)
install(SCRIPT cmake/install_headers.cmake COMPONENT dev)

set(thinwall_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/thinwall)
install(EXPORT thinwall NAMESPACE thinwall:: FILE thinwallTargets.cmake DESTINATION ${thinwall_cmake_dir} COMPONENT dev)
configure_package_config_file(cmake/thinwallConfig.cmake.in ${PROJECT_BINARY_DIR}/thinwallConfig.cmake
                              INSTALL_DESTINATION ${thinwall_cmake_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/thinwallConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/thinwallConfig.cmake ${PROJECT_BINARY_DIR}/thinwallConfigVersion.cmake
        DESTINATION ${thinwall_cmake_dir} COMPONENT dev)

list(TRANSFORM THINWALL_EIGEN_ALIGNMENT PREPEND -D OUTPUT_VARIABLE thinwall_pc_definitions)
list(JOIN thinwall_pc_definitions " " thinwall_pc_definitions)
file(RELATIVE_PATH thinwall_pc_prefix /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(cmake/thinwall.pc.in ${PROJECT_BINARY_DIR}/thinwall.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/thinwall.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
