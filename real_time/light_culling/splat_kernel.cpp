// SPDX-License-Identifier: Apache-2.0
// Rasterisation of geodesic spheres at full resolution (Dachsbacher and Stamminger 2006): a light is given to each
// pixel whose surface lies before one of the 80 triangles, seen from inside. Of a convex polyhedron each ray leaves
// through one such triangle, also where the eye is inside, so each pixel is covered once. Edges are functions of the
// ray, linear in its slopes, and need no vertex in front of the eye.
#include "equations/cpp/wide.h"
#include "real_time/light_culling/cull_kernel.h"
#include "real_time/light_culling/proxy_kernel.h"

namespace luciole::LUCIOLE_ISA {
namespace {
// In the order of dependence, which is not that of the alphabet.
// clang-format off
#include "real_time/light_culling/side_planes.inc"
#include "real_time/light_culling/proxy.inc"
// clang-format on

constexpr int kTriangles = GeodesicProxy::kTriangles;
constexpr int kCells = 4;              // per side of a tile
constexpr float kOverlap = 1.0f / 16;  // of a cell's side: where in the pixel the ray goes, and rounding
constexpr float kFar = 1e30f;
constexpr int kRegisters = kTriangles / kLanes;

// A linear function of a ray's slopes: x * ray.x + y * ray.y + z.
enum Row : int {
  kEdge = 0,    // three functions, not negative inside the triangle
  kPlane = 9,   // one function: the triangle's depth along the ray is the limit over it
  kLimit = 12,  // > 0: the triangle is seen from inside; others have no cells
  kLeft,
  kRight,
  kTop,
  kBottom,    // cells with fractions, of the part beyond the nearest surface; left > right: none
  kFarthest,  // depth of the triangle's farthest corner, with what rounding may lose [m]
  kRows
};

struct alignas(64) Triangles {
  float row[kRows][kTriangles];
};

struct LinearFunction {
  real x, y, z;
};

// ray -> v . (factor * ray), and a bound of what is lost by rounding for slopes up to 2.
LUCIOLE_FN LinearFunction of_ray(const TriangularFactor& m, real3 v) {
  return {m.m00 * v.x, m.m01 * v.x + m.m11 * v.y, m.m02 * v.x + m.m12 * v.y + m.m22 * v.z};
}
LUCIOLE_FN real rounding(const TriangularFactor& m, real3 v) {
  const real3 a = abs(v);
  return 1e-6f * ((m.m00 + abs(m.m01) + abs(m.m02)) * a.x + (m.m11 + abs(m.m12)) * a.y + m.m22 * a.z);
}

LUCIOLE_FN real3 load_corner(const GeodesicProxy& proxy, int corner, int first) {
  return real3(load(proxy.corner[corner][0] + first), load(proxy.corner[corner][1] + first),
               load(proxy.corner[corner][2] + first));
}

struct CellExtent {
  real left = kFar, right = -kFar, top = kFar, bottom = -kFar;

  LUCIOLE_FN void add(const TileBand& band, real x_slope, real y_slope, mask chosen) {
    const real x = (x_slope - band.x_first) * (kCells / band.x_step);
    const real y = (y_slope - band.y_first) * (kCells / band.y_step);
    left = select(chosen, min(x, left), left), right = select(chosen, max(x, right), right);
    top = select(chosen, min(y, top), top), bottom = select(chosen, max(y, bottom), bottom);
  }
  LUCIOLE_FN void add(const CellExtent& e, mask chosen) {
    left = select(chosen, min(e.left, left), left), right = select(chosen, max(e.right, right), right);
    top = select(chosen, min(e.top, top), top), bottom = select(chosen, max(e.bottom, bottom), bottom);
  }
};

// Only what lies beyond the nearest surface can cover a pixel.
LUCIOLE_FN CellExtent extent_of(const TileBand& band, const real3 (&corner)[3]) {
  const real nearest = depth_of_slice(band.slices, 0) * (1.0f - 1e-5f), inverse_nearest = 1.0f / nearest;
  CellExtent extent;
  for (int k = 0; k < 3; ++k) {
    const real3 a = corner[k], b = corner[(k + 1) % 3];
    const mask beyond = a.z >= nearest, next_beyond = b.z >= nearest;
    const real inverse_depth = inverse(a.z);
    extent.add(band, a.x * inverse_depth, a.y * inverse_depth, beyond);
    const mask cut = (beyond || next_beyond) && !(beyond && next_beyond);
    if (!any(cut)) continue;
    const real t = (nearest - a.z) / (b.z - a.z);
    extent.add(band, (a.x + (b.x - a.x) * t) * inverse_nearest, (a.y + (b.y - a.y) * t) * inverse_nearest, cut);
  }
  return extent;
}

LUCIOLE_FN float least(real v) {
  alignas(64) float lanes[kLanes];
  store(lanes, v);
  float low = lanes[0];
  for (int lane = 1; lane < kLanes; ++lane) low = lanes[lane] < low ? lanes[lane] : low;
  return low;
}
LUCIOLE_FN float greatest(real v) { return -least(-v); }

// What all triangles reach.
struct Splat {
  ScreenRectangle cells;
  float farthest;  // [m]
};

// Triangle by triangle, one per lane. In the stretched space the sphere is at the origin and the eye at -stretched.
LUCIOLE_FN Splat set_up(const ProxyEllipsoid& e, const GeodesicProxy& proxy, const TileBand& band, Triangles& out) {
  CellExtent all;
  real farthest = -kFar;
  const real depth_rounding = 4e-6f * (abs(e.test.centre.z) + e.inverse.m22);
  for (int first = 0; first < kTriangles; first += kLanes) {
    const auto put = [&](int row, real value) { store(out.row[row] + first, value); };
    const auto put_function = [&](int row, LinearFunction f) { put(row, f.x), put(row + 1, f.y), put(row + 2, f.z); };
    const real3 normal =
        real3(load(proxy.normal[0] + first), load(proxy.normal[1] + first), load(proxy.normal[2] + first));
    const real limit = load(proxy.distance + first) + dot(normal, e.test.stretched);
    real3 stretched_corner[3], corner[3];
    for (int k = 0; k < 3; ++k) {
      stretched_corner[k] = load_corner(proxy, k, first);
      corner[k] = to_view(e, stretched_corner[k]);
    }
    for (int k = 0; k < 3; ++k) {
      const real3 p = stretched_corner[k], q = stretched_corner[(k + 1) % 3];
      const real3 side = cross(p, q) + cross(e.test.stretched, q - p);  // (p + stretched) x (q + stretched)
      LinearFunction edge = of_ray(e.test.factor, side);
      edge.z += rounding(e.test.factor, side);  // no pixel falls between two triangles
      put_function(kEdge + 3 * k, edge);
    }
    put_function(kPlane, of_ray(e.test.factor, normal));
    put(kLimit, limit);
    const CellExtent beyond = extent_of(band, corner);
    CellExtent extent;
    extent.add(beyond, limit > 0.0f), all.add(beyond, limit > 0.0f);
    put(kLeft, extent.left), put(kRight, extent.right), put(kTop, extent.top), put(kBottom, extent.bottom);
    const real farthest_corner = max(max(corner[0].z, corner[1].z), corner[2].z) + depth_rounding;
    put(kFarthest, farthest_corner);
    farthest = max(farthest_corner, farthest);
  }
  const ScreenRectangle w = rectangle_of(band.window);
  return {{larger(whole_below(least(all.left) - kOverlap), w.column_begin * kCells),
           smaller(whole_below(greatest(all.right) + kOverlap) + 1, w.column_end * kCells),
           larger(whole_below(least(all.top) - kOverlap), w.row_begin * kCells),
           smaller(whole_below(greatest(all.bottom) + kOverlap) + 1, w.row_end * kCells)},
          greatest(farthest)};
}

// Which pixels of a cell one triangle covers.
LUCIOLE_FN std::uint32_t covered_pixels(const CellPixels& cell, const Triangles& t, int i) {
  const auto at = [&](int row, real x, real y) {
    return t.row[row][i] * x + (t.row[row + 1][i] * y + t.row[row + 2][i]);
  };
  std::uint32_t bits = 0;
  for (int lane = 0; lane < kGroupPixels; lane += kLanes) {
    const real x = load(cell.x + lane), y = load(cell.y + lane), depth = load(cell.depth + lane);
    const real edges = min(min(at(kEdge, x, y), at(kEdge + 3, x, y)), at(kEdge + 6, x, y));
    bits |= lane_bits(edges >= 0.0f && depth * at(kPlane, x, y) <= t.row[kLimit][i]) << lane;
  }
  return bits;
}

// Triangles that reach a row of cells, a bit each.
struct RowTriangles {
  std::uint32_t bits[kRegisters];
};

LUCIOLE_FN RowTriangles triangles_of_row(const Triangles& t, int row) {
  const float top = static_cast<float>(row) - kOverlap, bottom = static_cast<float>(row + 1) + kOverlap;
  RowTriangles of_row;
  for (int r = 0; r < kRegisters; ++r) {
    const int first = r * kLanes;
    of_row.bits[r] = lane_bits(load(t.row[kTop] + first) <= bottom && load(t.row[kBottom] + first) >= top);
  }
  return of_row;
}

// Which pixels of a cell all triangles cover. Triangles that end before the cell's nearest pixel are not looked at, as
// hierarchical depth tests leave them out.
LUCIOLE_FN std::uint32_t covered_pixels(const CellPixels& cell, float nearest, const Triangles& t,
                                        const RowTriangles& row, int column, std::uint64_t& tests) {
  const float left = static_cast<float>(column) - kOverlap, right = static_cast<float>(column + 1) + kOverlap;
  std::uint32_t covered = 0;
  for (int r = 0; r < kRegisters; ++r) {
    if (row.bits[r] == 0) continue;
    const int first = r * kLanes;
    const mask meets = load(t.row[kLeft] + first) <= right && load(t.row[kRight] + first) >= left &&
                       load(t.row[kFarthest] + first) >= nearest;
    for (std::uint32_t bits = row.bits[r] & lane_bits(meets); bits != 0; bits &= bits - 1) {
      ++tests;
      covered |= covered_pixels(cell, t, first + __builtin_ctz(bits));
      if (covered == 0xffffu) return covered;  // each pixel is covered once
    }
  }
  return covered;
}

// Of the covered pixels, those above the light's surface; raises their counts.
LUCIOLE_FN std::uint32_t count_pixels(const TileBand& band, const SurfacePlane& surface, const CellPixels& cell,
                                      std::uint32_t covered, float* covering) {
  std::uint32_t kept = 0;
  for (int lane = 0; lane < kGroupPixels; lane += kLanes) {
    const real x = load(cell.x + lane), y = load(cell.y + lane), depth = load(cell.depth + lane);
    const real height = (surface.normal.x * x + surface.normal.y * y + surface.normal.z) * depth;
    mask pixels = mask_from_bits(covered >> lane);
    if (band.test != TileTest::paper) pixels = pixels && height >= surface.offset;
    store(covering + lane, load(covering + lane) + select(pixels, real(1.0f), real(0.0f)));
    kept |= lane_bits(pixels) << lane;
  }
  return kept;
}

std::uint32_t splat_light(const ProxyEllipsoid& e, std::uint32_t light, const TileBand& band, const SplatCells& cells,
                          const GeodesicProxy& proxy, float* covering, LightSpan* spans, std::uint64_t& tests) {
  tests += kTriangles;
  Triangles triangles;
  const Splat splat = set_up(e, proxy, band, triangles);
  const ScreenRectangle& all = splat.cells;
  if (is_empty(all)) return 0;
  std::uint32_t count = 0;
  for (int tile_row = all.row_begin / kCells; tile_row * kCells < all.row_end; ++tile_row) {
    RowTriangles rows[kCells];
    for (int k = 0; k < kCells; ++k) rows[k] = triangles_of_row(triangles, tile_row * kCells + k);
    for (int tile_column = all.column_begin / kCells; tile_column * kCells < all.column_end; ++tile_column) {
      const auto tile = static_cast<std::uint32_t>(tile_row) * band.columns + static_cast<std::uint32_t>(tile_column);
      std::uint32_t part = band.first[tile], reached = 0;
      for (std::uint32_t left = band.occupied[tile]; left != 0; left &= left - 1, ++part) {
        if (cells.nearest[part] > splat.farthest) continue;
        const int cell = __builtin_ctz(left);
        const CellPixels& pixels = cells.pixels[part];
        const std::uint32_t covered = covered_pixels(pixels, cells.nearest[part], triangles, rows[cell / kCells],
                                                     tile_column * kCells + cell % kCells, tests);
        if (covered == 0) continue;
        const std::uint32_t kept =
            count_pixels(band, e.test.surface, pixels, covered, covering + std::size_t(part) * kGroupPixels);
        if (kept != 0) reached |= 1u << cell;
      }
      if (reached != 0) spans[count++] = {light, tile, reached};
    }
  }
  return count;
}

}  // namespace

std::uint32_t splat_lights(const BoundBlock& block, std::uint32_t first_light, const TileBand& band,
                           const GeodesicProxy& proxy, const SplatCells& cells, float* covering, LightSpan* spans,
                           std::uint64_t& tests) {
  std::uint32_t count = 0;
  for (std::uint32_t near = lights_near(block, band); near != 0; near &= near - 1) {
    const int lane = __builtin_ctz(near);
    count += splat_light(load_proxy(block, lane), first_light + static_cast<std::uint32_t>(lane), band, cells, proxy,
                         covering, spans + count, tests);
  }
  return count;
}

}  // namespace luciole::LUCIOLE_ISA
