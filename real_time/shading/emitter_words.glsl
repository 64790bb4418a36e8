// SPDX-License-Identifier: Apache-2.0
// Emitters as words, which go through shared memory or between the invocations of a subgroup. Included after
// pixel_sums.glsl, with LUCIOLE_LIGHTS_BY_SUBGROUP where they go from one invocation to another.
#ifndef LUCIOLE_EMITTER_WORDS_GLSL
#define LUCIOLE_EMITTER_WORDS_GLSL

const uint kEmitterWords = kKind == 0u ? 24u : kKind == 1u ? 32u : 16u;  // from one to the next, in memory
const uint kMostUsed = 25u;
const uint kUsedWords = kKind == 0u ? 20u : kKind == 1u ? kMostUsed : 16u;  // without those that fill up

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Words { float value[]; };

#define THREE(first) float[3](w[first], w[first + 1], w[first + 2])

// In the order of the members (emitters.h).
DiffuseEmitter diffuse_emitter(float w[kMostUsed]) {
  return DiffuseEmitter(THREE(0), THREE(3), THREE(6), THREE(9), THREE(12), w[15], w[16], w[17], w[18], w[19],
                        float[4](0.0, 0.0, 0.0, 0.0));
}

GlossyEmitter glossy_emitter(float w[kMostUsed]) {
  return GlossyEmitter(THREE(0), THREE(3), THREE(6), THREE(9), THREE(12), w[15], w[16], w[17], THREE(18), w[21], w[22],
                       w[23], w[24], float[7](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0));
}

ManyEmitter many_emitter(float w[kMostUsed]) {
  return ManyEmitter(THREE(0), THREE(3), THREE(6), w[9], w[10], w[11], w[12], w[13], w[14], w[15]);
}

#undef THREE

void add_light_of_words(inout ShadedPixel pixel, float w[kMostUsed]) {
  if (kKind == 0u) {
    const DiffuseEmitter light = diffuse_emitter(w);
    ADD_LIGHT(light)
  } else if (kKind == 1u) {
    const GlossyEmitter light = glossy_emitter(w);
    ADD_LIGHT(light)
  } else {
    const ManyEmitter light = many_emitter(w);
    ADD_LIGHT(light)
  }
}

// The emitter of an entry, as this invocation reads it.
void read_words(uint entry, out float w[kMostUsed]) {
  for (uint i = 0u; i < kMostUsed; ++i) w[i] = 0.0;
  for (uint i = 0u; i < kUsedWords; ++i) w[i] = Words(push.emitters).value[entry * kEmitterWords + i];
}

#if defined(LUCIOLE_LIGHTS_BY_SUBGROUP)
#extension GL_KHR_shader_subgroup_shuffle : require
// The emitter that another invocation of the subgroup has read. Shuffles, as on llvmpipe a broadcast takes twice as long.
void words_from(uint invocation, float own[kMostUsed], out float w[kMostUsed]) {
  for (uint i = 0u; i < kMostUsed; ++i) w[i] = i < kUsedWords ? subgroupShuffle(own[i], invocation) : 0.0;
}
#endif

#endif
