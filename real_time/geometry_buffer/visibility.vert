// SPDX-License-Identifier: Apache-2.0
// Corners of triangles on the screen: three vertices per triangle, an instance per mesh.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "real_time/device_scene/scene.glsl"
#include "real_time/geometry_buffer/visibility_records.h"

layout(push_constant, scalar) uniform Push { VisibilityPush push; };
layout(location = 0) flat out uvec2 shown;  // mesh and triangle

invariant gl_Position;  // those with holes meet those without

SceneRecord scene() { return SceneAt(push.scene).value; }

void main() {
  MeshRecords meshes = MeshRecords(scene().meshes);
  const uint vertex = WordsAt(meshes.value[gl_InstanceIndex].indices).value[gl_VertexIndex];
  const Projection to = push.projection;
  const vec3 p = floats3(meshes.value[gl_InstanceIndex].positions, vertex) - vector(to.eye);
  gl_Position = vec4(dot(vector(to.x), p), dot(vector(to.y), p), to.near, dot(vector(to.w), p));
  shown = uvec2(gl_InstanceIndex, gl_VertexIndex / 3);
}
