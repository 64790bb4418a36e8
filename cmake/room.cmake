# SPDX-License-Identifier: Apache-2.0

# luciole_room(name SOURCES a.cpp b.cpp LINK luciole_base tbb ... PRIVATE_LINK ...)
# A room of the house: static library luciole_<name>, public include path is the project root.
function(luciole_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(luciole_${name} STATIC ${ROOM_SOURCES})
  target_link_libraries(luciole_${name} PUBLIC luciole_flags ${ROOM_LINK} PRIVATE ${ROOM_PRIVATE_LINK})
endfunction()

# luciole_test(name SOURCES a_test.cpp LINK luciole_image ... [LABEL statistical])
# One test program; its label is `unit` (fast) unless it is said to be `statistical` (slow, still in ./do test).
# Tests find bundled data and scratch space by LUCIOLE_SOURCE_DIR and LUCIOLE_SCRATCH_DIR.
function(luciole_test name)
  if(NOT LUCIOLE_TESTS)
    return()
  endif()
  cmake_parse_arguments(TEST "" "LABEL" "SOURCES;LINK" ${ARGN})
  if(NOT TEST_LABEL)
    set(TEST_LABEL unit)
  endif()
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE luciole_flags ${TEST_LINK} GTest::gtest GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE LUCIOLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                             LUCIOLE_SCRATCH_DIR="${CMAKE_CURRENT_BINARY_DIR}")
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS ${TEST_LABEL})
endfunction()
