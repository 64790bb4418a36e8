# SPDX-License-Identifier: Apache-2.0

# luciole_embed(target name file)
# The text of a file as part of the program: adds `extern const char* const luciole::<name>` to the target. Whoever uses it
# declares it. A change of the file configures anew, and compiles.
function(luciole_embed target name file)
  cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE path)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  file(READ ${path} text)
  if(text MATCHES "\\)embedded\"")
    message(FATAL_ERROR "${file} has the mark that ends the literal it is embedded as")
  endif()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
namespace luciole {
extern const char* const @name@;
const char* const @name@ = R"embedded(@text@)embedded";
}  // namespace luciole
]])
  target_sources(${target} PRIVATE ${source})
endfunction()
