// SPDX-License-Identifier: Apache-2.0
// Conservative rasterisation of icosahedra at the resolution of tiles (Örtegren and Persson 2016): the least and the
// largest depth that the proxy has in each tile. The part of a convex polyhedron in a tile's frustum has its extreme
// depths where three planes meet: at vertices of the polyhedron, where its edges cross the borders of tiles, and where
// the rays through the corners of tiles enter and leave it. These are all visited, so the clusters are just those that
// the polyhedron touches. Rays that start inside enter at the eye. Unless the lists are to be the paper's, a tile test
// then drops the clusters that the proxy touches but the ellipsoid does not, or that its light's surface hides.
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

// Tiles overlap by this part of their side: rounding at a border loses nothing, nor does a pixel that lies on one.
constexpr float kOverlap = 1.0f / 64;
constexpr float kFar = 1e30f;
constexpr int kEdgeRegisters = 32 / kLanes;

struct ProxyEdges {
  real from[kEdgeRegisters][3], to[kEdgeRegisters][3];  // view space [m]
};

LUCIOLE_FN void put(real (&to)[3], real3 v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

LUCIOLE_FN real3 load_point(const float* x, const float* y, const float* z) { return real3(load(x), load(y), load(z)); }

LUCIOLE_FN ProxyEdges edges_of(const ProxyEllipsoid& e, const IcosahedronProxy& proxy) {
  ProxyEdges edges;
  for (int r = 0; r < kEdgeRegisters; ++r) {
    const auto point = [&](const float(&p)[3][32]) {
      return to_view(e, load_point(p[0] + r * kLanes, p[1] + r * kLanes, p[2] + r * kLanes));
    };
    put(edges.from[r], point(proxy.edge_from)), put(edges.to[r], point(proxy.edge_to));
  }
  return edges;
}

// Slopes of what lies at the nearest surface's depth or beyond it.
struct SlopeRange {
  float x_low = kFar, x_high = -kFar, y_low = kFar, y_high = -kFar;

  LUCIOLE_FN void add(real x, real y, mask chosen) {
    alignas(64) float xs[kLanes], ys[kLanes];
    store(xs, x), store(ys, y);
    for (std::uint32_t bits = lane_bits(chosen); bits != 0; bits &= bits - 1) {
      const float px = xs[__builtin_ctz(bits)], py = ys[__builtin_ctz(bits)];
      x_low = px < x_low ? px : x_low, x_high = px > x_high ? px : x_high;
      y_low = py < y_low ? py : y_low, y_high = py > y_high ? py : y_high;
    }
  }
};

LUCIOLE_FN SlopeRange slopes_of(const ProxyEllipsoid& e, const IcosahedronProxy& proxy, const ProxyEdges& edges,
                                float nearest) {
  SlopeRange range;
  for (int first = 0; first < IcosahedronProxy::kVertices; first += kLanes) {
    const real3 v = to_view(e, load_point(proxy.vertex[0] + first, proxy.vertex[1] + first, proxy.vertex[2] + first));
    const real inverse_depth = 1.0f / v.z;
    range.add(v.x * inverse_depth, v.y * inverse_depth, v.z >= nearest);
  }
  for (int r = 0; r < kEdgeRegisters; ++r) {
    const real(&a)[3] = edges.from[r], (&b)[3] = edges.to[r];
    const mask from_beyond = a[2] >= nearest, to_beyond = b[2] >= nearest;
    const mask cut = (from_beyond || to_beyond) && !(from_beyond && to_beyond);
    if (!any(cut)) continue;
    const real t = (nearest - a[2]) / (b[2] - a[2]), inverse_nearest = 1.0f / nearest;
    range.add((a[0] + (b[0] - a[0]) * t) * inverse_nearest, (a[1] + (b[1] - a[1]) * t) * inverse_nearest, cut);
  }
  return range;
}

LUCIOLE_FN ScreenRectangle tiles_in(const TileBand& band, const SlopeRange& s) {
  const float per_x = 1.0f / band.x_step, per_y = 1.0f / band.y_step;
  ScreenRectangle r;
  const ScreenRectangle window = rectangle_of(band.window);
  r.column_begin = larger(whole_below((s.x_low - band.x_first) * per_x - kOverlap), window.column_begin);
  r.column_end = smaller(whole_below((s.x_high - band.x_first) * per_x + kOverlap) + 1, window.column_end);
  r.row_begin = larger(whole_below((s.y_high - band.y_first) * per_y - kOverlap), window.row_begin);
  r.row_end = smaller(whole_below((s.y_low - band.y_first) * per_y + kOverlap) + 1, window.row_end);
  return r;
}

// The depths of one proxy in the tiles of a rectangle.
class CoveredTiles {
 public:
  LUCIOLE_FN CoveredTiles(const TileBand& band, const ScreenRectangle& tiles, const TileDepths& depths)
      : band_(band), tiles_(tiles), depths_(depths) {
    const int count = (tiles.column_end - tiles.column_begin) * (tiles.row_end - tiles.row_begin);
    for (int i = 0; i < count; ++i) depths_.low[i] = kFar, depths_.high[i] = -kFar;
  }

  const TileBand& band() const { return band_; }
  const ScreenRectangle& tiles() const { return tiles_; }

  LUCIOLE_FN void add(int column, int row, float low, float high) {
    if (column < tiles_.column_begin || column >= tiles_.column_end) return;
    if (row < tiles_.row_begin || row >= tiles_.row_end) return;
    const int i = index(column, row);
    depths_.low[i] = low < depths_.low[i] ? low : depths_.low[i];
    depths_.high[i] = high > depths_.high[i] ? high : depths_.high[i];
  }

  // Columns and rows with fractions.
  LUCIOLE_FN void add_point(float column, float row, float depth) {
    for (int c = whole_below(column - kOverlap); c <= whole_below(column + kOverlap); ++c) {
      for (int r = whole_below(row - kOverlap); r <= whole_below(row + kOverlap); ++r) add(c, r, depth, depth);
    }
  }

  LUCIOLE_FN int index(int column, int row) const {
    return (row - tiles_.row_begin) * (tiles_.column_end - tiles_.column_begin) + column - tiles_.column_begin;
  }

 private:
  const TileBand& band_;
  ScreenRectangle tiles_;
  TileDepths depths_;
};

LUCIOLE_FN void add_vertices(const ProxyEllipsoid& e, const IcosahedronProxy& proxy, CoveredTiles& tiles) {
  const TileBand& band = tiles.band();
  for (int first = 0; first < IcosahedronProxy::kVertices; first += kLanes) {
    const real3 v = to_view(e, load_point(proxy.vertex[0] + first, proxy.vertex[1] + first, proxy.vertex[2] + first));
    const real inverse_depth = 1.0f / v.z;
    alignas(64) float column[kLanes], row[kLanes], depth[kLanes];
    store(column, (v.x * inverse_depth - band.x_first) * (1.0f / band.x_step));
    store(row, (v.y * inverse_depth - band.y_first) * (1.0f / band.y_step));
    store(depth, v.z);
    for (std::uint32_t bits = lane_bits(v.z > 0.0f); bits != 0; bits &= bits - 1) {
      const int lane = __builtin_ctz(bits);
      tiles.add_point(column[lane], row[lane], depth[lane]);
    }
  }
}

// Where edges cross the borders between columns (axis 0) or rows (axis 1).
template <int axis>
LUCIOLE_FN void add_border_crossings(const ProxyEdges& edges, CoveredTiles& tiles) {
  constexpr int other = 1 - axis;
  const TileBand& band = tiles.band();
  const ScreenRectangle& t = tiles.tiles();
  const float first = axis == 0 ? band.x_first : band.y_first, step = axis == 0 ? band.x_step : band.y_step;
  const float other_first = axis == 0 ? band.y_first : band.x_first;
  const float per_other = 1.0f / (axis == 0 ? band.y_step : band.x_step);
  const int begin = axis == 0 ? t.column_begin : t.row_begin, end = axis == 0 ? t.column_end : t.row_end;
  for (int border = begin; border <= end; ++border) {
    const real slope = first + static_cast<float>(border) * step;
    for (int r = 0; r < kEdgeRegisters; ++r) {
      const real(&a)[3] = edges.from[r], (&b)[3] = edges.to[r];
      const real from = a[axis] - slope * a[2], to = b[axis] - slope * b[2];
      const mask crosses = (from <= 0.0f && to >= 0.0f) || (from >= 0.0f && to <= 0.0f);
      if (!any(crosses)) continue;
      const real share = from / (from - to);  // no number if the edge lies in the border: its ends are vertices
      const real z = a[2] + (b[2] - a[2]) * share;
      const real along = ((a[other] + (b[other] - a[other]) * share) / z - other_first) * per_other;
      alignas(64) float places[kLanes], depths[kLanes];
      store(places, along), store(depths, z);
      for (std::uint32_t bits = lane_bits(crosses && z > 0.0f); bits != 0; bits &= bits - 1) {
        const float place = places[__builtin_ctz(bits)], depth = depths[__builtin_ctz(bits)];
        for (int tile = whole_below(place - kOverlap); tile <= whole_below(place + kOverlap); ++tile) {
          for (int side = border - 1; side <= border; ++side) {
            axis == 0 ? tiles.add(side, tile, depth, depth) : tiles.add(tile, side, depth, depth);
          }
        }
      }
    }
  }
}

// Where rays through the corners of tiles enter and leave the slabs that the polyhedron is the meeting of.
LUCIOLE_FN void add_corners(const ProxyEllipsoid& e, const IcosahedronProxy& proxy, CoveredTiles& tiles) {
  alignas(64) static constexpr float kNumbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const TileBand& band = tiles.band();
  const ScreenRectangle& t = tiles.tiles();
  const TriangularFactor& m = e.test.factor;
  for (int row = t.row_begin; row <= t.row_end; ++row) {
    const real y = band.y_first + static_cast<float>(row) * band.y_step;
    for (int column = t.column_begin; column <= t.column_end; column += kLanes) {
      const real x = band.x_first + (load(kNumbers) + static_cast<float>(column)) * band.x_step;
      const real3 direction = real3(m.m00 * x + (m.m01 * y + m.m02), m.m11 * y + m.m12, m.m22);
      real low = 0.0f, high = kFar;
      for (int s = 0; s < IcosahedronProxy::kSlabs; ++s) {
        const real3 normal = real3(proxy.slab_normal[0][s], proxy.slab_normal[1][s], proxy.slab_normal[2][s]);
        const real middle = dot(normal, e.test.stretched), inverse_slope = inverse(dot(normal, direction));
        const real first = (middle - proxy.distance) * inverse_slope,
                   second = (middle + proxy.distance) * inverse_slope;
        // A ray along the slab gives no number, and leaves the bounds as they are.
        low = max(min(first, second), low), high = min(max(first, second), high);
      }
      alignas(64) float lows[kLanes], highs[kLanes];
      store(lows, low), store(highs, high);
      const std::uint32_t last = static_cast<std::uint32_t>(smaller(kLanes, t.column_end + 1 - column));
      const std::uint32_t wanted = (1u << last) - 1u;
      for (std::uint32_t bits = lane_bits(low <= high) & wanted; bits != 0; bits &= bits - 1) {
        const int lane = __builtin_ctz(bits), corner = column + lane;
        for (int c = corner - 1; c <= corner; ++c) {
          for (int r = row - 1; r <= row; ++r) tiles.add(c, r, lows[lane], highs[lane]);
        }
      }
    }
  }
}

// The slices of a frame, one per lane, a little thicker than they are: for rounding.
struct SliceBorders {
  alignas(64) float low[ClusterSlices::kCount], high[ClusterSlices::kCount];  // [m]

  LUCIOLE_FN explicit SliceBorders(const ClusterSlices& slices) {
    for (std::uint32_t s = 0; s < ClusterSlices::kCount; ++s) {
      low[s] = depth_of_slice(slices, s) * (1.0f - 1e-5f), high[s] = depth_of_slice(slices, s + 1) * (1.0f + 1e-5f);
    }
  }
};

// Where a proxy is farther from its ellipsoid than a tile test is: the slices of a tile that pass the test as well.
LUCIOLE_FN std::uint32_t slices_touched(const TileTestEllipsoid& e, const TileBand& band, const SliceBorders& borders,
                                        int column, int row) {
  Tile tile;
  tile.x_low = band.x_first + (static_cast<float>(column) - kOverlap) * band.x_step;
  tile.x_high = band.x_first + (static_cast<float>(column + 1) + kOverlap) * band.x_step;
  tile.y_low = band.y_first + (static_cast<float>(row + 1) + kOverlap) * band.y_step;
  tile.y_high = band.y_first + (static_cast<float>(row) - kOverlap) * band.y_step;
  std::uint32_t slices = 0;
  for (int first = 0; first < static_cast<int>(ClusterSlices::kCount); first += kLanes) {
    tile.near_low = tile.far_low = load(borders.low + first),
    tile.near_high = tile.far_high = load(borders.high + first);
    const mask touched = band.test == TileTest::exact ? ellipsoid_touches_tile_exactly(e, tile).near_half
                                                      : ellipsoid_touches_tile(e, tile).near_half;
    slices |= lane_bits(touched) << first;
  }
  return slices;
}

LUCIOLE_FN std::uint32_t slices_of(const TileBand& band, float low, float high) {
  const float nearer = low * (1.0f - 1e-5f), farther = high * (1.0f + 1e-5f);
  if (!(nearer <= farther) || farther < depth_of_slice(band.slices, 0)) return 0;
  if (nearer > depth_of_slice(band.slices, ClusterSlices::kCount)) return 0;
  const std::uint32_t first = cluster_slice_of(band.slices, nearer < 0.0f ? 0.0f : nearer);
  const std::uint32_t last = cluster_slice_of(band.slices, farther);
  return (0xffffffffu << first) & (0xffffffffu >> (ClusterSlices::kCount - 1 - last));
}

std::uint32_t cluster_light(const ProxyEllipsoid& e, std::uint32_t light, const TileBand& band,
                            const SliceBorders& borders, const IcosahedronProxy& proxy, const TileDepths& depths,
                            LightSpan* spans, std::uint64_t& tests) {
  tests += IcosahedronProxy::kTriangles;
  const ProxyEdges edges = edges_of(e, proxy);
  const ScreenRectangle rectangle = tiles_in(band, slopes_of(e, proxy, edges, borders.low[0]));
  if (is_empty(rectangle)) return 0;
  tests += static_cast<std::uint32_t>((rectangle.column_end - rectangle.column_begin) *
                                      (rectangle.row_end - rectangle.row_begin));
  CoveredTiles tiles(band, rectangle, depths);
  add_vertices(e, proxy, tiles);
  add_border_crossings<0>(edges, tiles);
  add_border_crossings<1>(edges, tiles);
  add_corners(e, proxy, tiles);
  std::uint32_t count = 0;
  for (int row = rectangle.row_begin; row < rectangle.row_end; ++row) {
    for (int column = rectangle.column_begin; column < rectangle.column_end; ++column) {
      const std::uint32_t tile = static_cast<std::uint32_t>(row) * band.columns + static_cast<std::uint32_t>(column);
      const int i = tiles.index(column, row);
      std::uint32_t slices = slices_of(band, depths.low[i], depths.high[i]) & band.occupied[tile];
      // The paper's lists are those of the proxies.
      if (slices != 0 && band.test != TileTest::paper) slices &= slices_touched(e.test, band, borders, column, row);
      if (slices != 0) spans[count++] = {light, tile, slices};
    }
  }
  return count;
}

}  // namespace

std::uint32_t cluster_lights(const BoundBlock& block, std::uint32_t first_light, const TileBand& band,
                             const IcosahedronProxy& proxy, const TileDepths& depths, LightSpan* spans,
                             std::uint64_t& tests) {
  const std::uint32_t near = lights_near(block, band);
  if (near == 0) return 0;
  const SliceBorders borders(band.slices);
  std::uint32_t count = 0;
  for (std::uint32_t bits = near; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    count += cluster_light(load_proxy(block, lane), first_light + static_cast<std::uint32_t>(lane), band, borders,
                           proxy, depths, spans + count, tests);
  }
  return count;
}

}  // namespace luciole::LUCIOLE_ISA
