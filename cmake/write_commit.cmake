# cmake -DSOURCE=... -DFILE=... -P write_commit.cmake     writes a source file with the commit of the sources
#
# Every build runs it; the file is written only if the commit has changed. Sources without a repository have no commit.
set(commit "")
if(EXISTS ${SOURCE}/.git)
  execute_process(COMMAND git --no-optional-locks -C ${SOURCE} describe --always --dirty --abbrev=12 "--exclude=*"
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
set(text "#include \"app/doctor.hpp\"\n
namespace thinwall::app {\n
std::string program_commit() {\n  return \"${commit}\";\n}\n
}  // namespace thinwall::app\n")
if(EXISTS ${FILE})
  file(READ ${FILE} before)
endif()
if(NOT "${before}" STREQUAL "${text}")
  file(WRITE ${FILE} "${text}")
endif()
