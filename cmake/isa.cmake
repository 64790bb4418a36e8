# SPDX-License-Identifier: Apache-2.0

# luciole_isa_sources(target kernel.cpp)
# Adds kernel.cpp to the target three times, compiled for AVX-512, for AVX2 with FMA, and for plain x86-64, with
# LUCIOLE_ISA naming the namespace of each (equations/cpp/wide.h). All code of kernel.cpp must live in that namespace;
# callers choose one of the three at run time (luciole::supports, equations/cpp/instruction_set.h).
function(luciole_isa_sources target source)
  cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE path)
  cmake_path(GET source STEM stem)
  set(avx512_flags -mavx512f -mavx512dq -mavx512vl -mavx512bw -mavx2 -mfma)
  set(avx2_flags -mavx2 -mfma)
  set(baseline_flags)
  foreach(isa avx512 avx2 baseline)
    set(wrapper ${CMAKE_CURRENT_BINARY_DIR}/${target}_${stem}_${isa}.cpp)
    file(CONFIGURE OUTPUT ${wrapper} CONTENT "#define LUCIOLE_ISA ${isa}\n#include \"${path}\"\n")
    set(flags ${${isa}_flags})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # GCC 12 reports the deliberately undefined registers inside its own intrinsics headers.
      list(APPEND flags -Wno-uninitialized -Wno-maybe-uninitialized)
    endif()
    set_source_files_properties(${wrapper} PROPERTIES COMPILE_OPTIONS "${flags}" OBJECT_DEPENDS ${path})
    target_sources(${target} PRIVATE ${wrapper})
  endforeach()
endfunction()

# luciole_isa_symbol_test(name target): a test that the target's objects of luciole_isa_sources share no symbol with code
# for other processors. Add it for each target that uses luciole_isa_sources.
function(luciole_isa_symbol_test name target)
  if(LUCIOLE_TESTS)
    add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -DNM=${CMAKE_NM} "-DOBJECTS=$<JOIN:$<TARGET_OBJECTS:${target}>,,>" -P
                                  ${PROJECT_SOURCE_DIR}/cmake/check_symbols.cmake)
    set_tests_properties(${name} PROPERTIES LABELS unit)
  endif()
endfunction()
