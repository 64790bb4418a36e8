// SPDX-License-Identifier: Apache-2.0
// From what a file says about a mesh to what Mesh promises: compact, unit normals, tangents where normal maps need
// them.
#pragma once
#include <string>

#include "scene/scene.h"

namespace luciole {

// Drops vertices that no triangle uses: exporters let many primitives share one long vertex list.
void drop_unused_vertices(Mesh& mesh);

// Makes every normal a unit vector; one without direction becomes the normal of a triangle at that vertex.
void normalise_normals(Mesh& mesh);

// Gives each corner vertices of its own, so that something may differ from triangle to triangle.
void separate_triangles(Mesh& mesh);

// Tangents for a normal map read through `slot`, after the idea of MikkTSpace (M. S. Mikkelsen, "Simulation of Wrinkled
// Surfaces Revisited", 2008): the gradients of u over the triangles at a vertex, projected into its tangent plane and
// weighted by the corner's angle; triangles whose texture is mirrored never share a tangent with others (their vertices
// are split). Unlike MikkTSpace it trusts the file's vertices instead of welding them anew, so that baked maps of files
// without tangents may differ slightly along seams.
void add_tangents(Mesh& mesh, const TextureSlot& slot);

// Moves a mesh to the world. Fails, naming `object`, if a position leaves the range of numbers that can be rendered.
void transform_mesh(Mesh& mesh, const Affine& world_from_mesh, const std::string& object);

}  // namespace luciole
