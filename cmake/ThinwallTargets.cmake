# thinwall_library(<folder> LINKS ...)   makes the target thinwall::<folder> from every .cpp of the folder and its sub-folders.
#     EXCLUDES <pattern>    leaves out sources whose path matches, because they belong to another target
#     TEXT                  is for folders without computations; JSON is among their precompiled headers
#     OWN_HEADERS           is for targets whose options differ from those of the shared precompiled headers
# thinwall_test(<name> LINKS ...)        makes one GoogleTest program from every .cpp of the current folder, with a ctest entry for each suite
#     OPTIMISED <source>... names sources that compute much by themselves: these alone are optimised, each by itself

add_library(thinwall_flags INTERFACE)
target_compile_options(thinwall_flags INTERFACE -Wall -Wextra -Wpedantic -Wsuggest-override
                                                -Wzero-as-null-pointer-constant -Werror)
# Hidden names are reported by gcc alone, which can leave out names of other files of a batch: in batches it reports names
# hidden within a function.
if(THINWALL_BATCHES)
  target_compile_options(thinwall_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>)
else()
  target_compile_options(thinwall_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wshadow>)
endif()
# Calls within the library may be direct and inlined: the compiler may assume that no library loaded before (LD_PRELOAD)
# replaces one of its functions.
target_compile_options(thinwall_flags INTERFACE -fno-semantic-interposition)
# GCC 12 warns wrongly about "text" + std::string, as overlapping copies, and, where the library's headers are
# precompiled, as copies beyond the end (GCC bug 105329, fixed in GCC 13).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(thinwall_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict>)
  # It reports members of Eigen's and CGAL's templates as used before they are set, which is shown, but stops no build.
  target_compile_options(thinwall_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-error=maybe-uninitialized>)
  if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_compile_options(thinwall_flags INTERFACE "$<$<COMPILE_LANGUAGE:CXX>:-Wno-array-bounds;-Wno-stringop-overflow>")
  endif()
endif()
if(THINWALL_NATIVE)
  # AVX-512 is left out: GCC 12 warns about its own AVX-512 headers (GCC bug 105593), and the dense algebra is
  # OpenBLAS's, which chooses its kernels at run time.
  target_compile_options(thinwall_flags INTERFACE -march=native -mno-avx512f)
endif()
# clang unrolls every loop as long as the buffer of decoded instructions of the processor may hold it, and for the newest
# ones of AMD (-march=native) it takes this buffer for 4096 instructions: twice the code, a fifth of the compiler's time.
# Loops whose number of turns is known are still unrolled.
target_compile_options(thinwall_flags INTERFACE
  "$<$<COMPILE_LANG_AND_ID:CXX,Clang>:SHELL:-mllvm -unroll-runtime=false -mllvm -unroll-partial-threshold=64>")
set(THINWALL_SUITE_TIMEOUT 1800)  # seconds
if(THINWALL_SANITIZE)
  set(THINWALL_SUITE_TIMEOUT 10800)  # the longest suites take more than half an hour, where others take minutes
  target_compile_options(thinwall_flags INTERFACE -fsanitize=${THINWALL_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(thinwall_flags INTERFACE -fsanitize=${THINWALL_SANITIZE})
endif()

# The alignment of Eigen's matrices depends on the vector unit for which a file is compiled; the layout of structs and
# the way in which their memory is freed depend on it too. It is pinned to that of AVX, so that programs compiled for
# any x86-64 processor fit a library compiled for any other. It is part of the library's interface: programs that use
# the library must be compiled with the same two definitions.
set(THINWALL_EIGEN_ALIGNMENT EIGEN_MAX_ALIGN_BYTES=32 EIGEN_MAX_STATIC_ALIGN_BYTES=32)

# Headers that nearly every file includes are parsed once for all targets with equal options: thinwall_headers contains
# them for the libraries. A file must still include all headers that it uses, which the build with sanitizers checks, as it
# has no precompiled headers (CMAKE_DISABLE_PRECOMPILE_HEADERS).
# Those of core/ keep Eigen's decompositions and products from being compiled by every file again.
set(THINWALL_COMMON_HEADERS <Eigen/Geometry> <Eigen/LU> <Eigen/SparseCore> <algorithm> <cmath> <filesystem> <functional>
                            <map> <memory> <numeric> <optional> <sstream> <string> <vector>
                            ${PROJECT_SOURCE_DIR}/core/dense_eigenvalues.hpp
                            ${PROJECT_SOURCE_DIR}/core/dense_products.hpp)

# thinwall_precompiled(<name> <header>...)   makes a target whose precompiled headers other targets reuse
function(thinwall_precompiled name)
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/${name}.cpp CONTENT "// Only for the headers that are parsed with it.\n")
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/${name}.cpp)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${name} PRIVATE ${THINWALL_EIGEN_ALIGNMENT})
  target_link_libraries(${name} PRIVATE thinwall_flags Eigen3::Eigen nlohmann_json::nlohmann_json Threads::Threads)
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()
thinwall_precompiled(thinwall_headers ${THINWALL_COMMON_HEADERS})
# Headers for folders without computations, which write and read JSON. These folders are optimised less than the others:
# what clang inlines it optimises again at each call, so that it takes two thirds of its time for case/ where the size of
# what is inlined is held to 25 instead of 225. Functions that are declared inline have a limit of their own.
thinwall_precompiled(thinwall_text_headers ${THINWALL_COMMON_HEADERS} <nlohmann/json.hpp>)
set(thinwall_text_options "$<$<COMPILE_LANG_AND_ID:CXX,Clang>:SHELL:-O1 -mllvm -inline-threshold=25>")

# Puts the sources of a target into batches of about THINWALL_BATCH_SIZE, each compiled at once (THINWALL_BATCHES): what
# its sources have in common, headers and instances of templates, is compiled once for all of them. The batches of a
# target are of nearly equal size, so that two cores finish together. Sources that include one of the large libraries are
# put into separate batches, so that its headers are parsed once only and its names cannot collide with those of many
# other files.
function(thinwall_batches target)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    file(STRINGS ${source} foreign REGEX "^#include <(CGAL|vtk|toml|CLI|cereal)" LIMIT_COUNT 1)
    string(REGEX MATCH "CGAL|vtk|toml|CLI|cereal" kind "${foreign}")
    if(NOT kind)
      set(kind ours)
    endif()
    list(APPEND kinds ${kind})
    list(APPEND sources_${kind} ${source})
  endforeach()
  list(REMOVE_DUPLICATES kinds)
  foreach(kind IN LISTS kinds)
    list(LENGTH sources_${kind} number)
    set(taken 0)
    math(EXPR batches "(${number} + ${THINWALL_BATCH_SIZE} - 1) / ${THINWALL_BATCH_SIZE}")
    foreach(source IN LISTS sources_${kind})
      math(EXPR batch "${taken} * ${batches} / ${number}")
      math(EXPR taken "${taken} + 1")
      set_property(SOURCE ${source} PROPERTY UNITY_GROUP ${kind}_${batch})
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # GCC takes an anonymous namespace for that of another file if its own file is included into a batch.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

function(thinwall_library name)
  cmake_parse_arguments(ARG "TEXT;OWN_HEADERS" "EXCLUDES" "LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  list(SORT sources COMPARE FILE_BASENAME)  # which files share a batch does not depend on their sub-folders
  if(ARG_EXCLUDES)
    list(FILTER sources EXCLUDE REGEX "${ARG_EXCLUDES}[^/]*$")
  endif()
  add_library(thinwall_${name} STATIC ${sources})
  if(ARG_OWN_HEADERS)
    target_precompile_headers(thinwall_${name} PRIVATE ${THINWALL_COMMON_HEADERS})
  elseif(ARG_TEXT)
    target_precompile_headers(thinwall_${name} REUSE_FROM thinwall_text_headers)
    target_compile_options(thinwall_${name} PRIVATE "$<$<CONFIG:Release>:${thinwall_text_options}>")
  else()
    target_precompile_headers(thinwall_${name} REUSE_FROM thinwall_headers)
  endif()
  if(NOT ARG_TEXT)
    set_property(GLOBAL APPEND PROPERTY THINWALL_COMPUTING thinwall_${name})
  endif()
  if(THINWALL_BATCHES)
    thinwall_batches(thinwall_${name})
  endif()
  target_include_directories(thinwall_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_compile_definitions(thinwall_${name} PUBLIC ${THINWALL_EIGEN_ALIGNMENT})
  target_link_libraries(thinwall_${name} PUBLIC ${ARG_LINKS} PRIVATE thinwall_flags ${ARG_PRIVATE_LINKS})
  add_library(thinwall::${name} ALIAS thinwall_${name})
endfunction()

# Sets `result` to the libraries with computations that the given ones need, themselves among them, the lowest last.
function(thinwall_computing result)
  set(left ${ARGN})
  while(left)
    list(POP_FRONT left library)
    string(REPLACE "::" "_" library "${library}")
    if(library MATCHES "^thinwall_" AND NOT library IN_LIST needed)
      list(APPEND needed ${library})
      get_target_property(links ${library} LINK_LIBRARIES)
      list(APPEND left ${links})
    endif()
  endwhile()
  get_property(computing GLOBAL PROPERTY THINWALL_COMPUTING)
  list(REVERSE computing)
  foreach(library IN LISTS computing)
    if(library IN_LIST needed)
      list(APPEND found ${library})
    endif()
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

# A ctest entry runs a suite, not a test, because starting a program for each of 1600 tests, with a hundred libraries
# each, takes a minute more. The suites are listed by the program after it was built. Each source has a namespace of its
# own, named as the file is, so that sources which are compiled as one may have helpers of the same name.
function(thinwall_test name)
  cmake_parse_arguments(ARG "" "" "LINKS;OPTIMISED" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_executable(test_${name} ${sources})
  target_link_libraries(test_${name} PRIVATE thinwall_flags ${ARG_LINKS} GTest::gtest_main)
  # Without optimisation tests are compiled in half the time. Templates that a test and a library both hold would then
  # be slow in the library, too, if the linker met the test's copy first.
  target_compile_options(test_${name} PRIVATE $<$<CONFIG:Release>:-O0>)
  thinwall_computing(computing ${ARG_LINKS})
  list(TRANSFORM computing REPLACE "(.+)" "$<TARGET_FILE:\\1>")
  target_link_options(test_${name} PRIVATE "LINKER:--whole-archive" ${computing} "LINKER:--no-whole-archive")
  if(ARG_OPTIMISED)
    set_source_files_properties(${ARG_OPTIMISED} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O2>
                                SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  if(name STREQUAL "core")
    target_precompile_headers(test_${name} PRIVATE ${THINWALL_COMMON_HEADERS} <gtest/gtest.h>)
  else()
    target_precompile_headers(test_${name} REUSE_FROM test_core)
  endif()
  if(THINWALL_BATCHES)
    thinwall_batches(test_${name})
  endif()
  target_compile_definitions(test_${name} PRIVATE THINWALL_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                                  THINWALL_BUILD_DIR="${PROJECT_BINARY_DIR}")
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/test_${name}_suites.cmake)
  add_custom_command(TARGET test_${name} POST_BUILD VERBATIM BYPRODUCTS ${suites}
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:test_${name}> -DLABEL=${name} -DFILE=${suites}
            -DSECONDS=${PROJECT_SOURCE_DIR}/tests/seconds.txt -DTIMEOUT=${THINWALL_SUITE_TIMEOUT}
            -P ${PROJECT_SOURCE_DIR}/cmake/list_suites.cmake)
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/test_${name}.cmake "if(EXISTS \"${suites}\")
  include(\"${suites}\")
else()
  add_test(test_${name}_NOT_BUILT test_${name}_NOT_BUILT)
endif()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/test_${name}.cmake)
endfunction()
