# SPDX-License-Identifier: Apache-2.0
find_program(GLSLC glslc REQUIRED)

# luciole_shader(target name file [OPTIONS ...])
# A shader as part of the program: compiles GLSL to SPIR-V for Vulkan 1.3 and adds `extern const gpu::ShaderCode
# luciole::<name>` to the target. Whoever uses it declares it. The file's extension says the stage: .comp, .vert, .frag.
# Headers are found from the root of the project; a change of any of them compiles anew. OPTIONS go to glslc.
function(luciole_shader target name file)
  cmake_parse_arguments(SHADER "" "" "OPTIONS" ${ARGN})
  cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE path)
  set(words ${CMAKE_CURRENT_BINARY_DIR}/${name}.spv.inc)
  add_custom_command(
    OUTPUT ${words}
    COMMAND ${GLSLC} -std=460 --target-env=vulkan1.3 -Werror -O -I${PROJECT_SOURCE_DIR}
            ${SHADER_OPTIONS} -mfmt=num -MD -MF ${words}.d -MT ${words} -o ${words} ${path}
    DEPENDS ${path}
    DEPFILE ${words}.d
    COMMENT "Compiling shader ${name}"
    VERBATIM)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.spv.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
#include "gpu/shader_code.h"
namespace luciole {
namespace {
constexpr std::uint32_t kWords[] = {
#include "@words@"
};
}  // namespace
extern const gpu::ShaderCode @name@;
const gpu::ShaderCode @name@ = {"@name@", kWords, sizeof(kWords)};
}  // namespace luciole
]])
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS ${words})
  target_sources(${target} PRIVATE ${source})
endfunction()
