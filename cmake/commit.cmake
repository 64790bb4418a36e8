# SPDX-License-Identifier: Apache-2.0

# luciole_commit(result)
# The abbreviated commit of the checkout, "+" behind it if tracked files were changed; empty outside git, so that a
# build from an archive is the same everywhere. Read at configure time: `./do build` configures each time.
function(luciole_commit result)
  set(commit "")
  find_program(LUCIOLE_GIT git)
  mark_as_advanced(LUCIOLE_GIT)
  if(LUCIOLE_GIT AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
    execute_process(COMMAND ${LUCIOLE_GIT} describe --always --exclude=* --abbrev=12 --dirty=+
                    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE commit
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
  set(${result} "${commit}" PARENT_SCOPE)
endfunction()
