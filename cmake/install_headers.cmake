# Installs the headers to include/thinwall, in their folders; run by `cmake --install`. In the sources they include each
# other relative to the root ("mesh/box.hpp"). In a directory that many libraries share they must do so under the
# library's name ("thinwall/mesh/box.hpp"), so that no `mesh` or `io` of another library is found instead. Headers that
# need those of CHOLMOD, Open CASCADE, cereal, JSON or MUMPS are not installed; no other header includes them.
set(internal linalg/cholmod.hpp io/surface/step_triangles.hpp case/schema/json_schema.hpp
             study/kept/archive.hpp study/kept/archive_models.hpp)
list(JOIN THINWALL_FOLDERS "|" folders)
set(staged ${THINWALL_BINARY_DIR}/installed_headers)
file(REMOVE_RECURSE ${staged})
foreach(folder IN LISTS THINWALL_FOLDERS)
  file(GLOB_RECURSE headers RELATIVE ${THINWALL_SOURCE_DIR} ${THINWALL_SOURCE_DIR}/${folder}/*.hpp)
  list(REMOVE_ITEM headers ${internal})
  list(FILTER headers EXCLUDE REGEX "^distributed/ranks/")
  foreach(header IN LISTS headers)
    file(READ ${THINWALL_SOURCE_DIR}/${header} text)
    string(REGEX REPLACE "#include \"(${folders})/" "#include \"thinwall/\\1/" text "${text}")
    file(WRITE ${staged}/${header} "${text}")
  endforeach()
endforeach()
file(INSTALL DESTINATION ${THINWALL_INCLUDE_DIR}/thinwall TYPE DIRECTORY FILES ${staged}/)
