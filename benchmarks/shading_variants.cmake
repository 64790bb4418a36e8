# SPDX-License-Identifier: Apache-2.0
# The kernels of the variants: beside the engine's, made of its text.
set(engine_kernel ${PROJECT_SOURCE_DIR}/real_time/shading/shade_tiles.comp)
add_library(luciole_shading_variants STATIC EXCLUDE_FROM_ALL
  shading_variants/comparison.cpp shading_variants/device_stage.cpp shading_variants/errors.cpp
  shading_variants/variants.cpp)
target_link_libraries(luciole_shading_variants PUBLIC luciole_real_time luciole_settings)
foreach(name all_kinds appended_by_atomics depth_masks half_precision persistent_groups split_culling split_shading
             staged_lights)
  luciole_shader(luciole_shading_variants ${name} shading_variants/${name}.comp)
endforeach()
luciole_shader(luciole_shading_variants depth_masks_and_halves shading_variants/depth_masks.comp OPTIONS -DAND_HALVES)
luciole_shader(luciole_shading_variants subgroup_lists shading_variants/subgroup_lists.comp)
luciole_shader(luciole_shading_variants subgroup_lists_by_subgroup shading_variants/subgroup_lists.comp
               OPTIONS -DLUCIOLE_LIGHTS_BY_SUBGROUP)
luciole_shader(luciole_shading_variants batches_of_256 ${engine_kernel} OPTIONS -DBATCH=256)
luciole_shader(luciole_shading_variants batches_of_512 ${engine_kernel} OPTIONS -DBATCH=512)
luciole_shader(luciole_shading_variants small_tiles ${engine_kernel} OPTIONS -DTILE_SIDE=8)
luciole_shader(luciole_shading_variants small_tiles_by_subgroup ${engine_kernel}
               OPTIONS -DTILE_SIDE=8 -DLUCIOLE_LIGHTS_BY_SUBGROUP)
