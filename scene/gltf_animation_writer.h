// SPDX-License-Identifier: Apache-2.0
// The animation of a scene as glTF; inner to the writer (gltf_writer.h).
#pragma once
#include <cstddef>
#include <vector>

#include "scene/animation.h"
#include "scene/gltf_writer_parts.h"

namespace luciole::gltf {

// The object's entry in the animation, or null where it rests or nothing moves.
const MovingMesh* moving_mesh(const Scene& scene, std::size_t mesh);
bool is_moving_light(const Scene& scene, std::size_t light);
bool is_moving_camera(const Scene& scene, std::size_t camera);

// Adds the moving nodes, what hangs on them, and their tracks.
//   meshes  per mesh of the scene, its number in the document; lights and cameras keep theirs
void add_animation(const Scene& scene, const std::vector<std::size_t>& meshes, BufferWriter& buffer, Json& document);

}  // namespace luciole::gltf
