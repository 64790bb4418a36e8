# SPDX-License-Identifier: Apache-2.0
# The room real_time/filtering: noisy light -> clean light. Included by real_time/CMakeLists.txt.
set(filtering ${CMAKE_CURRENT_LIST_DIR}/filtering)
luciole_room(real_time_filtering
  SOURCES ${filtering}/bilateral_filter.cpp ${filtering}/temporal_accumulation.cpp
  LINK luciole_base)
luciole_isa_sources(luciole_real_time_filtering ${filtering}/gather_tile.cpp)
luciole_isa_sources(luciole_real_time_filtering ${filtering}/filter_tile.cpp)
# Multiply-adds are contracted where the instruction set has them; GCC does so anyway.
target_compile_options(luciole_real_time_filtering PRIVATE -ffp-contract=fast)

add_library(luciole_synthetic_room STATIC EXCLUDE_FROM_ALL ${filtering}/synthetic_room.cpp)
target_link_libraries(luciole_synthetic_room PUBLIC luciole_flags)

luciole_test(filtering_test
  SOURCES ${filtering}/bilateral_filter_test.cpp ${filtering}/reference_filter.cpp
  LINK luciole_real_time_filtering luciole_synthetic_room luciole_settings)
