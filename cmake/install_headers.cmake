# Run by `cmake --install`: the headers into include/thinwall, in their folders. In the sources they name each other from
# the root ("mesh/box.hpp"); where many libraries share one include directory they do so under the library's name
# ("thinwall/mesh/box.hpp"), so that no `mesh` or `io` of another comes between. Those that need headers of CHOLMOD and of
# Open CASCADE stay here; no other header names them.
set(internal linalg/cholmod.hpp io/surface/step_triangles.hpp case/json_schema.hpp
             study/kept/archive.hpp study/kept/archive_models.hpp)
list(JOIN THINWALL_FOLDERS "|" folders)
set(staged ${THINWALL_BINARY_DIR}/installed_headers)
file(REMOVE_RECURSE ${staged})
foreach(folder IN LISTS THINWALL_FOLDERS)
  file(GLOB_RECURSE headers RELATIVE ${THINWALL_SOURCE_DIR} ${THINWALL_SOURCE_DIR}/${folder}/*.hpp)
  list(REMOVE_ITEM headers ${internal})
  foreach(header IN LISTS headers)
    file(READ ${THINWALL_SOURCE_DIR}/${header} text)
    string(REGEX REPLACE "#include \"(${folders})/" "#include \"thinwall/\\1/" text "${text}")
    file(WRITE ${staged}/${header} "${text}")
  endforeach()
endforeach()
file(INSTALL DESTINATION ${THINWALL_INCLUDE_DIR}/thinwall TYPE DIRECTORY FILES ${staged}/)
