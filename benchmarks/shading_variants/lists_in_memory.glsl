// SPDX-License-Identifier: Apache-2.0
// The lists between the two kernels of the split variant: per tile a header, then room for a subset per half.

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer HeaderAt { ListHeader value; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ListAt { uint value[]; };

HeaderAt header_at(uvec3 tile, uvec3 tiles) {
  const uint64_t place = (uint64_t(tile.z) * tiles.y + tile.y) * tiles.x + tile.x;
  return HeaderAt(more + place * (24u + 8u * push.light_count));
}

ListAt list_at(uvec3 tile, uvec3 tiles, uint half_of_tile) {
  return ListAt(uint64_t(header_at(tile, tiles)) + 24u + 4u * half_of_tile * push.light_count);
}
