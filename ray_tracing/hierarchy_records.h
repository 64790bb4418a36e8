// SPDX-License-Identifier: Apache-2.0
// A bounding volume hierarchy as kernels of a device read it (trace.glsl), shared with C++.
//
// A reference is one word: kNothing; or, with the bit kLeaf, up to 8 triangles, bits 28 to 30 their number less one and
// the bits below the first of them; or the number of a node.
#ifndef LUCIOLE_HIERARCHY_RECORDS_H
#define LUCIOLE_HIERARCHY_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

const word_ kNothing = 0xffffffffu;
const word_ kLeaf = 0x80000000u;
const word_ kLeafCountShift = 28u;
const word_ kLeafFirstMask = 0x0fffffffu;

// References that wait while a ray goes down. No hierarchy needs more: build_hierarchy sees to it.
const word_ kTraceStack = 96u;

// The boxes of four children, one per lane, and what is in them. Lanes without a child have kNothing. 112 bytes, read
// in pieces of 16.
struct HierarchyNode {
  float low_x[4], low_y[4], low_z[4];
  float high_x[4], high_y[4], high_z[4];
  word_ child[4];  // references
};

// The triangles of a leaf follow each other. 48 bytes.
struct HierarchyTriangle {
  float a[3], b[3], c[3];  // corners, world [m]
  word_ mesh, triangle;    // indices in Scene::meshes and of the triangle in the mesh
  word_ has_holes;         // not 0: a ray may pass, its alpha decides
};

#if defined(__cplusplus)
static_assert(sizeof(HierarchyNode) == 112 && offsetof(HierarchyNode, child) == 96);
static_assert(sizeof(HierarchyTriangle) == 48 && offsetof(HierarchyTriangle, mesh) == 36);
#endif

LUCIOLE_RECORDS_END

#endif
