// SPDX-License-Identifier: Apache-2.0
// The kit's one surface: a grid of points. Lathes, sweeps, extrusions and mouldings are grids whose vertex normals are
// the area-weighted mean of their faces: large faces stay flat, and a narrow row of faces between them reads as a
// rounded edge. Meshes made here are in metres and have no material yet (Mesh::material = 0).
#pragma once
#include <functional>
#include <string>

#include "scene/scene.h"

namespace luciole::workshop {

// How finely round things are cut, from the recipes' `detail` in (0,1]: triangles grow in proportion to it.
struct Detail {
  float value = 1;
  // Segments of a thing that has `full` of them at full detail; never less than `least`.
  std::uint32_t segments(std::uint32_t full, std::uint32_t least = 6) const;
};

struct GridShape {
  std::uint32_t columns = 1, rows = 1;           // faces in u and v
  bool wrap_columns = false, wrap_rows = false;  // the last line is the first again, bit for bit
  Vec2 uv_size{1, 1};                            // texture coordinates run from 0 to this
};

// position(u, v) for u, v in [0,1]; the front is on the side of dP/du x dP/dv. Rows that shrink to a point (poles) and
// triangles without area are handled.
Mesh grid_surface(const GridShape& shape, const std::function<Vec3(float u, float v)>& position);

// The same from points that exist: (columns + 1) * (rows + 1), row by row; where the grid wraps, the last repeats the
// first.
Mesh grid_from_points(const GridShape& shape, std::vector<Vec3> points);

// Texture coordinates of a grid by place instead of number: u of each column, v of each row.
void set_uv(Mesh& mesh, const std::vector<float>& u, const std::vector<float>& v);

// A flat rectangle: corner, and its two sides; the front is along cross(side_u, side_v). uv in metres.
Mesh rectangle(Vec3 corner, Vec3 side_u, Vec3 side_v, std::uint32_t columns = 1, std::uint32_t rows = 1);

// A box round the origin whose edges are rounded off by `bevel` [m]: 44 triangles. uv in metres per face.
Mesh rounded_box(Vec3 size, float bevel);

// A flat cap over a convex loop of points, counter-clockwise seen from `normal`.
Mesh fan(const std::vector<Vec3>& loop, Vec3 normal);

// Adds `part` to `whole`, placed by `world_from_part` (mirrored placements keep their front outside).
void append(Mesh& whole, const Mesh& part, const Affine& world_from_part = {});
Mesh placed(const Mesh& mesh, const Affine& world_from_mesh);

// The other side is the front.
Mesh turned_inside_out(Mesh mesh);

// From texture coordinates in metres to repeats of a texture that is `tile` metres wide.
void scale_uv(Mesh& mesh, float tile);

// Tangents along +u for normal maps, from uv set 0; as glTF has it, the bitangent runs up the picture, against +v.
void add_tangents(Mesh& mesh);

}  // namespace luciole::workshop
