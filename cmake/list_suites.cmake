# cmake -DPROGRAM=... -DLABEL=... -DFILE=... -DSECONDS=... -DTIMEOUT=... -P list_suites.cmake
# writes the ctest entries of a GoogleTest program.
#
# Suites that solve large models keep the memory that they have freed, as the program does (core::keep_freed_memory),
# because a fifth of their time would go to pages that the system takes back and gives again. Other suites do not, for
# some of them measure memory. Other C libraries than glibc ignore the wish.
#
# An entry runs a suite, with all values of its parameters, for TIMEOUT seconds at most. Suites that are named in SECONDS,
# a file of lines "suite seconds", begin in that order, the longest first, because a long suite that begins late leaves
# the other cores idle at the end.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
# The line "Running main() from ..." of the output is no suite; it contains blanks.
string(REGEX MATCHALL "(^|\n)[^ \n]+\\." lines "${listed}")
set(suites "")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^\n|\\.$" "" line "${line}")
  string(REGEX REPLACE "^[^/]*/([A-Za-z].*)$" "\\1" line "${line}")  # the values' name before a suite with parameters
  string(REGEX REPLACE "/[0-9]+$" "" line "${line}")                 # the number of a type behind a suite of types
  list(APPEND suites ${line})
endforeach()
list(REMOVE_DUPLICATES suites)
file(STRINGS ${SECONDS} seconds REGEX "^[A-Z]")
set(environment "")
if(LABEL MATCHES "^(structures|real_parts)$")
  set(environment GLIBC_TUNABLES=glibc.malloc.mmap_threshold=33554432:glibc.malloc.trim_threshold=18446744073709551615)
endif()
foreach(suite IN LISTS suites)
  set(cost 0)
  foreach(line IN LISTS seconds)
    if(line MATCHES "^${suite} +([0-9]+)$")
      set(cost ${CMAKE_MATCH_1})
    endif()
  endforeach()
  set(filter "${suite}.*:*/${suite}.*:${suite}/*.*:*/${suite}/*.*")
  string(APPEND text "add_test([=[${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${filter}]=])\n"
         "set_tests_properties([=[${suite}]=] PROPERTIES LABELS ${LABEL} TIMEOUT ${TIMEOUT} COST ${cost}\n"
         "  ENVIRONMENT [=[${environment}]=]\n"
         "  FAIL_REGULAR_EXPRESSION [=[Running 0 tests]=]\n"
         "  SKIP_REGULAR_EXPRESSION [=[0 tests\\.\n(\\[  SKIPPED [^\n]*\n)+$]=])\n")
endforeach()
file(WRITE ${FILE} "${text}")
