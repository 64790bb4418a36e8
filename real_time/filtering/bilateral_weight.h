// SPDX-License-Identifier: Apache-2.0
// How much a neighbour's light counts for a pixel: the cross bilateral weight. [TH17] section 6 filters interleaved
// samples by one of these and leaves its form open; this form is ours, made so that a tap costs 14 operations.
//
// Written in the language of equations/shading_language.h and read inside the namespace of an instantiation; no include
// guard on purpose. Every weight is the biweight max(0, 1 - t)^2, whose t adds three squared distances:
//
// - Place. A surface is compared with the pixel's tangent plane n.(x - eye) = k. With x - eye = z r, where r is the
//   pixel's ray scaled to depth 1, that plane has 1/z = (n.r)/k, which is affine in the pixel's coordinates. So
//       distance of q to the tangent plane of p / z_q = n.r_q - k/z_q
//   needs one stored number per pixel, 1/z, and two multiply-adds per tap. It is measured in footprints of a pixel at
//   depth z_q, so that no length enters: the picture of a scene a thousand times as large is the same.
// - Direction. 1 - n_p.n_q over 1 - cos(tolerance). A glossy lobe turns with the normal, so its tolerance is narrower:
//   alpha, the angle at which GGX falls to a quarter.
// - Roughness, for the specular part only: (2 alpha_q / alpha_p - 2)^2, so that a half more or less is too much. Other
//   materials may take part: the light is demodulated, so that only the shape of the lobe matters.

// Zero weight at this distance to the tangent plane [footprints of a pixel], half weight at 0.54 of it.
LUCIOLE_FN real plane_tolerance() { return real(2.0f); }
// 1 / (1 - cos 30 degrees): zero weight at this angle of the normals for the diffuse part, half weight at 16 degrees.
LUCIOLE_FN real diffuse_narrowness() { return LUCIOLE_REAL(7.46410161513775); }
// For the specular part: 1 - cos x = x^2/2 at x = alpha. The floor, 0.02 rad, is what float normals can tell apart.
LUCIOLE_FN real specular_narrowness(real ggx_alpha) {
  const real angle = max(ggx_alpha, real(0.02f));
  return max(2.0f / (angle * angle), diffuse_narrowness());
}

// The pixel that is being filtered.
struct FilterCentre {
  real3 normal;                  // shading normal, unit
  real plane_scale;              // -k in units of plane_tolerance() footprints
  real plane_offset;             // -n.r_p in the same units
  real plane_right, plane_down;  // change of plane_offset per pixel
  real specular_narrowness;
  real two_over_alpha;
};

// Of one pixel.
//   normal, geometric_normal  unit, on the viewer's side
//   depth        along the camera's forward axis [m], > 0
//   ray          from the eye to the pixel's sample, depth 1
//   right, up    of the camera, unit
//   footprint    width of a pixel at depth 1 [1]
LUCIOLE_FN FilterCentre filter_centre(real3 normal, real3 geometric_normal, real ggx_alpha, real depth, real3 ray,
                                      real3 right, real3 up, real footprint) {
  const real scale = inverse(plane_tolerance());
  // A plane seen edge-on still tells the sky (1/z = kNoInverseDepth) from a surface.
  const real facing = max(-dot(geometric_normal, ray), real(1e-6f)) * (scale / footprint);
  FilterCentre c;
  c.normal = normal;
  c.plane_scale = facing * depth;
  c.plane_offset = facing;
  c.plane_right = -dot(geometric_normal, right) * scale;
  c.plane_down = dot(geometric_normal, up) * scale;
  c.specular_narrowness = specular_narrowness(ggx_alpha);
  c.two_over_alpha = 2.0f / ggx_alpha;
  return c;
}

// plane_offset of the row that lies `down` pixels below.
LUCIOLE_FN real plane_offset_of_row(FilterCentre c, real down) { return c.plane_offset + down * c.plane_down; }

struct TapWeight {
  real diffuse, specular;  // [0,1]
};

// Of a neighbour in a row of plane offset `row_offset`, `right` pixels to the right. 14 operations.
LUCIOLE_FN TapWeight tap_weight(FilterCentre c, real row_offset, real right, real inverse_depth, real3 normal,
                                real ggx_alpha) {
  const real distance = inverse_depth * c.plane_scale - (row_offset + right * c.plane_right);
  const real near = 1.0f - distance * distance;
  const real turned = 1.0f - c.normal.x * normal.x - c.normal.y * normal.y - c.normal.z * normal.z;
  const real rougher = ggx_alpha * c.two_over_alpha - 2.0f;
  const real diffuse = max(near - turned * diffuse_narrowness(), real(0.0f));
  const real specular = max(near - turned * c.specular_narrowness - rougher * rougher, real(0.0f));
  TapWeight w;
  w.diffuse = diffuse * diffuse;
  w.specular = specular * specular;
  return w;
}
