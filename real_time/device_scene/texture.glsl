// SPDX-License-Identifier: Apache-2.0
// Texture look-ups with explicit level of detail: the text of scene/texture_sampling.h. Included by scene.glsl.

// Texel number of an unwrapped coordinate; `size` texels.
int wrapped(int i, int size, uint wrap) {
  int at = clamp(i, 0, size - 1);
  if (wrap == kWrapRepeat) at = i < 0 ? i + size : i >= size ? i - size : i;
  if (wrap == kWrapMirrored) at = i < 0 || i >= 2 * size ? 0 : i >= size ? 2 * size - 1 - i : i;
  return at;
}

// Reduces a coordinate so that it fits an integer, whatever it was; not-a-number becomes 0.
float reduced(float u, uint wrap) {
  if (wrap == kWrapRepeat) u -= floor(u);
  if (wrap == kWrapMirrored) u -= 2.0 * floor(u * 0.5);
  if (wrap == kWrapClamp) u = clamp(u, 0.0, 1.0);
  return u >= 0.0 && u <= 2.0 ? u : 0.0;
}

// Colours through the table of sRGB, or as they are; alpha as it is.
vec4 decoded(TextureRecord t, uint rgba) {
  const uvec4 code = uvec4(rgba & 255u, (rgba >> 8u) & 255u, (rgba >> 16u) & 255u, rgba >> 24u);
  vec4 value = vec4(code) / 255.0;
  if (t.srgb != 0u) {
    FloatsAt table = FloatsAt(scene().linear_from_srgb);
    value.xyz = vec3(table.value[code.x], table.value[code.y], table.value[code.z]);
  }
  return value;
}

vec4 texel_at(TextureRecord t, uint first, int width, int x, int y) {
  return decoded(t, WordsAt(t.texels).value[first + uint(y * width + x)]);
}

vec4 sample_level(TextureRecord t, uint level, vec2 uv, bool linear) {
  const int width = int(max(t.width >> level, 1u)), height = int(max(t.height >> level, 1u));
  const float x = uv.x * float(width), y = uv.y * float(height);
  const uint first = WordsAt(t.levels).value[level];
  if (!linear) return texel_at(t, first, width, wrapped(int(x), width, t.wrap_u), wrapped(int(y), height, t.wrap_v));
  // Texel centres lie at +0.5. The conversion truncates; x + 0.5 is positive.
  const int i = int(x + 0.5) - 1, j = int(y + 0.5) - 1;
  const int left = wrapped(i, width, t.wrap_u), right = wrapped(i + 1, width, t.wrap_u);
  const int above = wrapped(j, height, t.wrap_v), below = wrapped(j + 1, height, t.wrap_v);
  const float across = x - 0.5 - float(i), down = y - 0.5 - float(j);
  return texel_at(t, first, width, left, above) * ((1.0 - across) * (1.0 - down)) +
         texel_at(t, first, width, right, above) * (across * (1.0 - down)) +
         texel_at(t, first, width, left, below) * ((1.0 - across) * down) +
         texel_at(t, first, width, right, below) * (across * down);
}

// The texture's value, linear, each channel in [0,1].
//   uv   after the slot's transform; (0,0) is the corner of the top left texel
//   lod  see texture_level_of_detail; 0 or less looks at the finest level with the magnification filter
vec4 sample_texture(TextureRecord t, vec2 uv, float lod) {
  const vec2 at = vec2(reduced(uv.x, t.wrap_u), reduced(uv.y, t.wrap_v));
  const float coarsest = float(t.level_count - 1u);
  const bool minified = lod > 0.0, linear = (minified ? t.minify_linear : t.magnify_linear) != 0u;
  float level = minified && t.mip_filter != kMipNone ? min(lod, coarsest) : 0.0;
  if (t.mip_filter == kMipNearest) level = min(floor(level + 0.5), coarsest);
  const uint fine = uint(level);
  const float blend = level - float(fine);
  // A loop, so that the text of a level stands in the kernel once.
  vec4 value = vec4(0.0);
  for (uint i = 0u; i < (blend > 0.0 ? 2u : 1u); ++i) {
    value += sample_level(t, fine + i, at, linear) * (i == 0u ? 1.0 - blend : blend);
  }
  return value;
}

// The same of the finest level, without a loop: for the loop of trace.
vec4 sample_finest_level(TextureRecord t, vec2 uv) {
  return sample_level(t, 0u, vec2(reduced(uv.x, t.wrap_u), reduced(uv.y, t.wrap_v)), t.magnify_linear != 0u);
}
