# SPDX-License-Identifier: Apache-2.0

# luciole_room(name SOURCES a.cpp b.cpp LINK luciole_base tbb ... PRIVATE_LINK ...)
# A room of the house: static library luciole_<name>, public include path is the project root.
function(luciole_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(luciole_${name} STATIC ${ROOM_SOURCES})
  target_link_libraries(luciole_${name} PUBLIC luciole_flags ${ROOM_LINK} PRIVATE ${ROOM_PRIVATE_LINK})
endfunction()

# luciole_seldom_runs(target|source.cpp ...)
# Options and JSON, from header-only libraries, run once: compiling them for speed takes longer than they ever run.
# Not for what computes: in a target of these, a source that does takes back its -O3.
function(luciole_seldom_runs)
  set(level $<$<CONFIG:Release>:-O1>)
  if(LUCIOLE_SANITIZE)
    set(level -O0)
  endif()
  foreach(item ${ARGN})
    if(TARGET ${item})
      target_compile_options(${item} PRIVATE ${level})
    elseif(item MATCHES "\\.cpp$")
      set_source_files_properties(${item} PROPERTIES COMPILE_OPTIONS ${level})
    endif()
  endforeach()
endfunction()

# luciole_test_main: what all test programs link. They are compiled in one way, so that GoogleTest's header is compiled once for
# all of them; and not for speed, as most of their time is that of the rooms.
function(luciole_test_main)
  find_package(GTest REQUIRED)
  add_library(luciole_test_main STATIC ${PROJECT_SOURCE_DIR}/tests/main.cpp)
  target_link_libraries(luciole_test_main PUBLIC luciole_flags GTest::gtest)
  target_compile_options(luciole_test_main PUBLIC $<$<CONFIG:Release>:-O1> PRIVATE -fPIE)  # programs are, libraries are not
  target_precompile_headers(luciole_test_main PRIVATE <gtest/gtest.h>)
endfunction()

# luciole_test_program(name SOURCES a_test.cpp LINK luciole_image ...)
# A program of tests. It finds bundled data and scratch space by LUCIOLE_SOURCE_DIR and LUCIOLE_SCRATCH_DIR.
function(luciole_test_program name)
  cmake_parse_arguments(TEST "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE luciole_test_main ${TEST_LINK})
  target_precompile_headers(${name} REUSE_FROM luciole_test_main)
  target_compile_definitions(${name} PRIVATE LUCIOLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                             LUCIOLE_SCRATCH_DIR="${CMAKE_CURRENT_BINARY_DIR}")
endfunction()

# Slow tests begin first, so that none is left over that runs alone while other processors wait.
function(luciole_label test label)
  set_tests_properties(${test} PROPERTIES LABELS ${label})
  if(label STREQUAL "statistical")
    set_tests_properties(${test} PROPERTIES COST 1000)
  endif()
endfunction()

# luciole_test(name SOURCES a_test.cpp LINK luciole_image ... [LABEL statistical] [ONE_THREAD])
# One test program; its label is `unit` (fast) unless it is said to be `statistical` (slow, still in ./do test; not built
# with sanitizers, under which ./do check runs units alone). ONE_THREAD: what it tests starts no other, so that the thread
# sanitizer has nothing to see.
function(luciole_test name)
  if(NOT LUCIOLE_TESTS)
    return()
  endif()
  cmake_parse_arguments(TEST "ONE_THREAD" "LABEL" "SOURCES;LINK" ${ARGN})
  if(NOT TEST_LABEL)
    set(TEST_LABEL unit)
  endif()
  if((LUCIOLE_SANITIZE AND NOT TEST_LABEL STREQUAL "unit") OR (LUCIOLE_SANITIZE MATCHES "thread" AND TEST_ONE_THREAD))
    return()
  endif()
  luciole_test_program(${name} SOURCES ${TEST_SOURCES} LINK ${TEST_LINK})
  add_test(NAME ${name} COMMAND ${name})
  luciole_label(${name} ${TEST_LABEL})
endfunction()

# luciole_device_test(name SOURCES a_test.cpp LINK luciole_gpu ... [LABEL statistical] [WIDTHS 8])
# Tests on a Vulkan device, run as <name>_width_<n> for subgroups of 4, 8 and 16 invocations: so wide Mesa's software Vulkan
# makes them by its variable; other drivers ignore it. What it compiles, half a minute in all, it keeps beside the build. Under
# the thread sanitizer they are not built, as it would have to know the driver's threads; nor are leaks looked for, as drivers
# keep what they compiled.
function(luciole_device_test name)
  if(NOT LUCIOLE_TESTS)
    return()
  endif()
  cmake_parse_arguments(TEST "" "LABEL" "SOURCES;LINK;WIDTHS" ${ARGN})
  if(NOT TEST_LABEL)
    set(TEST_LABEL unit)
  endif()
  if(NOT TEST_WIDTHS)
    set(TEST_WIDTHS 4 8 16)
  endif()
  if(LUCIOLE_SANITIZE)
    if(NOT TEST_LABEL STREQUAL "unit")
      return()
    endif()
    set(TEST_WIDTHS 8)  # what sanitizers look at is the same for all
  endif()
  luciole_test_program(${name} SOURCES ${TEST_SOURCES} LINK ${TEST_LINK})
  if(LUCIOLE_SANITIZE MATCHES "thread")
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    return()
  endif()
  foreach(width ${TEST_WIDTHS})
    math(EXPR bits "${width} * 32")
    add_test(NAME ${name}_width_${width} COMMAND ${name})
    luciole_label(${name}_width_${width} ${TEST_LABEL})
    set_tests_properties(${name}_width_${width} PROPERTIES
      ENVIRONMENT "LP_NATIVE_VECTOR_WIDTH=${bits};ASAN_OPTIONS=detect_leaks=0;MESA_SHADER_CACHE_DIR=${PROJECT_BINARY_DIR}/shader_cache")
  endforeach()
endfunction()
