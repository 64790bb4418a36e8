// SPDX-License-Identifier: Apache-2.0
// What the filter divides light by, so that only illumination is averaged, and multiplies by afterwards. The albedo is
// already apart (Radiance); this takes out what Fresnel reflection does. Language and use as bilateral_weight.h.

// The least reflectance that counts as one: below it the division would blow up noise. Water has 0.02.
LUCIOLE_FN real least_specular_reflectance() { return real(0.02f); }
LUCIOLE_FN real least_diffuse_share() { return real(0.0625f); }

struct Demodulation {
  real diffuse;             // what Fresnel reflection leaves to the diffuse part, about 1 - max(f0)
  real3 specular;           // f0, per channel: coloured metals keep the pattern of their colour
  mask reflects_diffusely;  // false for metals, whose diffuse part says nothing about the light there
};

LUCIOLE_FN Demodulation demodulation(real3 f0) {
  const real left = 1.0f - max(max(f0.x, f0.y), f0.z);
  const real least = least_specular_reflectance();
  Demodulation d;
  d.diffuse = max(left, least_diffuse_share());
  d.specular = max(f0, real3(least, least, least));
  d.reflects_diffusely = left >= least_diffuse_share();
  return d;
}
