// SPDX-License-Identifier: Apache-2.0
// Whether a pixel of the frame before saw the surface that a pixel sees now, and what a mean over frames does: of the
// temporal accumulation of both engines. Language and use as bilateral_weight.h, for one pixel at a time.

// Of the same surface: normals no farther apart, and the tangent plane no farther off, in widths of a pixel there.
LUCIOLE_FN real least_normal_cosine() { return real(0.9f); }
LUCIOLE_FN real farthest_from_plane() { return real(1.0f); }
// A pixel of the past that counts less than this is left out.
LUCIOLE_FN real least_tap_weight() { return real(1e-3f); }

// The camera of the frame before.
struct PastView {
  real3 eye, right, up, forward;  // axes unit
  real pixel_size;                // width of a pixel at depth 1 [1]
  real width, height;             // [pixels]
  real sub_pixel_x, sub_pixel_y;  // where in the pixels its rays went
};

// Where a point was in the frame before, in pixels: at whole numbers lie the points that its pixels saw.
struct PastPlace {
  real x, y;
  real pixel_width;  // of a pixel there [m]; > 0 in front of the camera
};

LUCIOLE_FN PastPlace place_in_past(PastView view, real3 position) {
  const real3 d = position - view.eye;
  PastPlace place;
  place.pixel_width = view.pixel_size * dot(d, view.forward);
  place.x = dot(d, view.right) / place.pixel_width + 0.5f * view.width - view.sub_pixel_x;
  place.y = 0.5f * view.height - dot(d, view.up) / place.pixel_width - view.sub_pixel_y;
  return place;
}

// Of the pixel at (column, row), 0 ... 1: bilinear.
LUCIOLE_FN real tap_weight(PastPlace place, real column, real row) {
  return (1.0f - abs(place.x - column)) * (1.0f - abs(place.y - row));
}

// How a surface of the past lies to the one that is seen now.
struct Likeness {
  real normal_cosine, geometric_cosine;
  real off_plane;  // [m]
};

LUCIOLE_FN Likeness likeness(real3 position, real3 normal, real3 geometric_normal, real3 past_position,
                             real3 past_normal, real3 past_geometric_normal) {
  Likeness l;
  l.normal_cosine = dot(past_normal, normal);
  l.geometric_cosine = dot(past_geometric_normal, geometric_normal);
  l.off_plane = abs(dot(geometric_normal, past_position - position));
  return l;
}

LUCIOLE_FN mask is_same_surface(Likeness l, real pixel_width) {
  return l.normal_cosine >= least_normal_cosine() && l.geometric_cosine >= real(0.0f) &&
         l.off_plane <= farthest_from_plane() * pixel_width;
}

// How much of a mean of reflected light is still worth, seen from where the eye is now. The half vector turns by half
// of what the view turns, and the lobe is about alpha wide.
LUCIOLE_FN real worth_of_reflection(real3 position, real3 eye, real3 past_eye, real ggx_alpha) {
  const real3 turned = normalize(eye - position) - normalize(past_eye - position);
  const real width_sq = 4.0f * ggx_alpha * ggx_alpha;
  return width_sq / (width_sq + dot(turned, turned));
}

// Frames in a mean that goes on: `most` of the past, and this one.
LUCIOLE_FN real frames_with_this(real past_frames, real most) { return min(past_frames, most) + 1.0f; }
LUCIOLE_FN real3 mean_with_this(real3 past_mean, real3 light, real frames) {
  return past_mean + (light - past_mean) * inverse(frames);
}
