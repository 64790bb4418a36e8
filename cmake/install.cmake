# SPDX-License-Identifier: Apache-2.0
# `cmake --install`: libraries, headers, shader headers, the program, and a CMake package.
#   find_package(luciole)   target_link_libraries(mine PRIVATE luciole::real_time)   one target per room
#   luciole_INCLUDE_DIR     for shaders: #include "equations/stochastic_range.h"
# Include this after all rooms.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# The rooms that other programs may use; apps, tests and benchmarks stay here.
set(luciole_installed_folders base equations gpu image report scene shot ray_tracing real_time offline)

# Every library luciole_* that a folder or one below builds by default.
function(luciole_collect_rooms folder result)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  get_property(subfolders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  set(rooms)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    get_target_property(only_for_tests ${target} EXCLUDE_FROM_ALL)
    if(target MATCHES "^luciole_" AND type MATCHES "STATIC_LIBRARY|INTERFACE_LIBRARY" AND NOT only_for_tests)
      list(APPEND rooms ${target})
    endif()
  endforeach()
  foreach(subfolder ${subfolders})
    luciole_collect_rooms(${subfolder} below)
    list(APPEND rooms ${below})
  endforeach()
  set(${result} ${rooms} PARENT_SCOPE)
endfunction()

set(luciole_rooms luciole_flags)
foreach(folder ${luciole_installed_folders})
  luciole_collect_rooms(${PROJECT_SOURCE_DIR}/${folder} rooms)
  list(APPEND luciole_rooms ${rooms})
endforeach()
foreach(room ${luciole_rooms})
  string(REPLACE "luciole_" "" name ${room})
  set_target_properties(${room} PROPERTIES EXPORT_NAME ${name})
endforeach()
set(luciole_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/luciole)
install(TARGETS ${luciole_rooms} EXPORT luciole-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/luciole)
install(EXPORT luciole-targets NAMESPACE luciole:: DESTINATION ${luciole_package_dir})
if(TARGET luciole)
  install(TARGETS luciole RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# Folders keep their names, so that the same #include works inside and outside the tree.
foreach(folder ${luciole_installed_folders})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION include/luciole FILES_MATCHING
          PATTERN "*.h" PATTERN "*.inc" PATTERN "*.glsl" PATTERN browser EXCLUDE)
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/shots DESTINATION ${CMAKE_INSTALL_DATADIR}/luciole FILES_MATCHING
        PATTERN "*.toml")

if(LUCIOLE_EMBREE4_INCLUDE)
  set(LUCIOLE_EMBREE_VERSION 4)
else()
  set(LUCIOLE_EMBREE_VERSION 3.13)
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/luciole-config.cmake.in
                              ${PROJECT_BINARY_DIR}/luciole-config.cmake INSTALL_DESTINATION ${luciole_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/luciole-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/luciole-config.cmake ${PROJECT_BINARY_DIR}/luciole-config-version.cmake
        DESTINATION ${luciole_package_dir})
