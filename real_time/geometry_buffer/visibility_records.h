// SPDX-License-Identifier: Apache-2.0
// What the shaders that rasterise the geometry buffer are told, shared with C++.
#ifndef LUCIOLE_VISIBILITY_RECORDS_H
#define LUCIOLE_VISIBILITY_RECORDS_H
#include "base/shared_record.h"
#include "real_time/geometry_buffer/geometry_records.h"

LUCIOLE_RECORDS_BEGIN

// VkDrawIndirectCommand: all triangles of a mesh.
struct DrawRecord {
  word_ vertices;
  word_ instances;     // 0: not drawn
  word_ first_vertex;  // 0
  word_ mesh;          // as the number of the instance, by which shaders know it
};

// A point of the world, relative to the eye, on the screen: clip = (x . p, y . p, near, w . p). w . p is the depth [m],
// and near / depth what is compared (infinitely far is 0). The centre of a pixel is where its ray goes.
struct Projection {
  float eye[3];
  float x[3], y[3], w[3];
  float near;  // depth from which on triangles are drawn [m]
};

// A draw per mesh: first those of meshes without holes, then those with them; each mesh has one in both.
struct DrawsPush {
  address_ bounds;  // MeshBounds
  address_ draws;   // DrawRecord
  Projection projection;
  word_ meshes;
};

struct VisibilityPush {
  address_ scene;  // SceneRecord
  Projection projection;
  float top_left[3], across[3], down[3];  // of ScreenRays
};

struct ResolvePush {
  GeometryPush geometry;
  address_ visibility;  // per pixel mesh and triangle; kNothing: the sky
};

#if defined(__cplusplus)
static_assert(sizeof(DrawRecord) == 16 && sizeof(Projection) == 52);
static_assert(sizeof(DrawsPush) == 72 && offsetof(DrawsPush, meshes) == 68);
static_assert(sizeof(VisibilityPush) == 96 && offsetof(VisibilityPush, down) == 84);
static_assert(sizeof(ResolvePush) == 112 && offsetof(ResolvePush, visibility) == 104);
#endif

LUCIOLE_RECORDS_END

#endif
