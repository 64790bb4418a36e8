// SPDX-License-Identifier: Apache-2.0
// A tone curve: what a screen shows of an exposed colour. Written in the language of equations/shading_language.h and
// read inside the namespace of an instantiation; no include guard on purpose.

// What is negative, or no number, counts as 0; what no screen could tell from infinity as 1e30.
LUCIOLE_FN real above_zero(real x) { return select(x > real(0.0f), min(x, real(1e30f)), real(0.0f)); }
LUCIOLE_FN real3 above_zero3(real3 x) { return real3(above_zero(x.x), above_zero(x.y), above_zero(x.z)); }

// The part of a display's range [0,1] that is nearest; 0 where x is no number.
LUCIOLE_FN real within_unit(real x) { return select(x > real(0.0f), min(x, real(1.0f)), real(0.0f)); }
LUCIOLE_FN real3 within_unit3(real3 x) { return real3(within_unit(x.x), within_unit(x.y), within_unit(x.z)); }

// Khronos PBR Neutral Tone Mapper specification (Khronos Group, 2024); its F90, K_s, K_d in words:
//   1. What a dielectric of index 1.5 reflects at normal incidence (0.04) is taken off the darkest channel smoothly, so
//      that a white-lit surface shows its base colour.
//   2. A peak above 0.8 - 0.04 is compressed by a hyperbola towards 1, with slope 1 where it starts.
//   3. What is compressed is mixed towards white, the more the farther the peak moved.
//   exposed  linear, 0 ... 1e30 per channel
LUCIOLE_FN real3 pbr_neutral(real3 exposed) {
  const real reflection = real(0.04f);
  const real start = real(0.8f) - reflection;
  const real desaturation = real(0.15f);
  const real darkest = min(min(exposed.x, exposed.y), exposed.z);
  const real offset =
      select(darkest <= 2.0f * reflection, darkest - darkest * darkest / (4.0f * reflection), reflection);
  const real3 base = exposed - real3(offset, offset, offset);
  const real peak = max(max(base.x, base.y), base.z);
  // Where nothing is compressed the rest goes unused; a peak that starts compression keeps it from dividing by nothing.
  const real high = max(peak, start);
  const real compressed = 1.0f - (1.0f - start) * (1.0f - start) / (high + 1.0f - 2.0f * start);
  const real saturation = 1.0f / (desaturation * (high - compressed) + 1.0f);
  const real white = compressed * (1.0f - saturation);
  const real3 bright = base * (compressed / high * saturation) + real3(white, white, white);
  return select(peak <= start, base, bright);
}
