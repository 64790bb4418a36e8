# SPDX-License-Identifier: Apache-2.0
# Every header compiles alone as GLSL and as HLSL, and the probe through all of them makes valid SPIR-V.
find_program(GLSLC glslc REQUIRED)
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

# equations_shader_test(name includes glsl_body hlsl_body): two tests, glsl_<name> and hlsl_<name>
function(equations_shader_test name includes glsl_body hlsl_body)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/shaders)
  file(CONFIGURE OUTPUT ${folder}/${name}.comp CONTENT "#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
${includes}
layout(local_size_x = 64) in;
${glsl_body}
" @ONLY)
  file(CONFIGURE OUTPUT ${folder}/${name}.hlsl CONTENT "${includes}
${hlsl_body}
" @ONLY)
  add_test(NAME glsl_${name} COMMAND sh -ec
    "${GLSLC} -std=460 --target-env=vulkan1.3 -Werror -I${PROJECT_SOURCE_DIR} ${folder}/${name}.comp -o ${folder}/${name}.spv
     ${SPIRV_VAL} --target-env vulkan1.3 --scalar-block-layout ${folder}/${name}.spv")
  add_test(NAME hlsl_${name} COMMAND sh -ec
    "${GLSLANG_VALIDATOR} -D -V -S comp -e main -I${PROJECT_SOURCE_DIR} ${folder}/${name}.hlsl -o ${folder}/${name}.hlsl.spv
     ${SPIRV_VAL} --target-env vulkan1.0 ${folder}/${name}.hlsl.spv")
  set_tests_properties(glsl_${name} hlsl_${name} PROPERTIES LABELS unit)
endfunction()

file(GLOB headers RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
list(FILTER headers EXCLUDE REGEX "(test_support|wide_test_kernel|shading_language|equations_probe)\\.h$")
foreach(header IN LISTS headers)
  cmake_path(GET header STEM name)
  equations_shader_test(${name} "#include \"${header}\"" "void main() {}" "[numthreads(64, 1, 1)] void main() {}")
endforeach()

equations_shader_test(equations_probe "#include \"equations/equations_probe.h\""
  "layout(std430, binding = 0) readonly buffer Inputs { ProbeInput probe_inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { ProbeOutput probe_outputs[]; };
void main() { probe_outputs[gl_GlobalInvocationID.x] = probe_equations(probe_inputs[gl_GlobalInvocationID.x]); }"
  "RWStructuredBuffer<float> results : register(u0);
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  ProbeInput i;
  i.incident = float3(0.6, 0.0, 0.8);
  i.outgoing = float3(-0.6, 0.0, 0.8);
  i.ggx_alpha = results[id.x];
  i.f0 = 0.04;
  i.index = id.x;
  const ProbeOutput o = probe_equations(i);
  results[id.x] = o.xi + o.stratified_xi + o.specular + o.diffuse + o.probability + o.range_sq + o.spheroid_r_u +
                  o.fitted_r_w + o.tight_r_u + o.tight_r_w + o.box_distance_sq + o.exact_distance_sq + o.touches +
                  o.level_of_detail + o.shading_normal;
}")

# A reserved word or a type that only C++ knows must not pass unseen.
equations_shader_test(mistake "#include \"equations/random_number.h\"" "double f(real x) { return std_sqrt(x); } void main() {}"
  "[numthreads(64, 1, 1)] void main() { real3 x = std_sqrt(1.0); }")
set_tests_properties(glsl_mistake hlsl_mistake PROPERTIES WILL_FAIL TRUE)
