# SPDX-License-Identifier: Apache-2.0
# The front half of the frame: everything up to lights and pixels that can be shaded.
luciole_room(real_time_front
  SOURCES
    direct_light/direct_light.cpp
    direct_light/direct_sources.cpp
    geometry_buffer/geometry_buffer.cpp
    geometry_buffer/geometry_buffer_pass.cpp
    geometry_buffer/pixel_block.cpp
    many_lights/many_lights.cpp
    reflective_shadow_map/basis.cpp
    reflective_shadow_map/cell_partition.cpp
    reflective_shadow_map/light_map.cpp
    reflective_shadow_map/primary_light.cpp
    reflective_shadow_map/reflective_shadow_map.cpp
    sky_light/sky_light.cpp
    virtual_point_lights/virtual_point_lights.cpp
  LINK luciole_ray_tracing luciole_scene luciole_settings luciole_base)
luciole_isa_sources(luciole_real_time_front direct_light/direct_light_kernel.cpp)

luciole_test(light_map_test SOURCES reflective_shadow_map/light_map_test.cpp LINK luciole_real_time_front)
luciole_test(geometry_buffer_test SOURCES geometry_buffer/geometry_buffer_test.cpp LINK luciole_real_time_front)
luciole_test(virtual_point_lights_test SOURCES virtual_point_lights/virtual_point_lights_test.cpp
             LINK luciole_real_time_front)
luciole_test(many_lights_test SOURCES many_lights/many_lights_test.cpp LINK luciole_real_time_front)
luciole_test(direct_light_test SOURCES direct_light/direct_light_test.cpp LINK luciole_real_time_front)
luciole_test(sky_light_test SOURCES sky_light/sky_light_test.cpp LINK luciole_real_time_front)
