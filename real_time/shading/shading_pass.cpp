// SPDX-License-Identifier: Apache-2.0
#include "real_time/shading/shading_pass.h"

#include <algorithm>
#include <mutex>

#include "base/parallel.h"
#include "real_time/shading/list_worker.h"
#include "real_time/shading/tile_worker.h"

namespace luciole {
namespace {

// On all threads: the first touch of new memory takes longer than writing it.
void clear(Radiance& radiance, std::size_t pixels) {
  radiance.resize(pixels);
  for (Plane3* planes : {&radiance.diffuse, &radiance.specular}) {
    for (Plane& plane : *planes) {
      parallel_for(pixels, std::size_t(1) << 19, [&](std::size_t begin, std::size_t end) {
        std::fill(plane.data() + begin, plane.data() + end, 0.0f);
      });
    }
  }
}

void add_counts(LightCounts& to, const LightCounts& from) {
  to.tests += from.tests, to.listed += from.listed, to.evaluated += from.evaluated, to.accepted += from.accepted;
}

// All blocks of 16n x 16n pixels.
TileWindow whole_frame(const ShadingInputs& inputs) {
  const std::uint32_t side = kTileSide * inputs.settings.interleave;
  return {0, (inputs.geometry.width + side - 1) / side, 0, (inputs.geometry.height + side - 1) / side};
}

// make_worker() gives each range of blocks a worker of its own; its memory is reused from block to block.
template <class MakeWorker>
void run_blocks(const TileWindow& window, ShadingOutputs& out, const MakeWorker& make_worker) {
  const std::size_t columns = window.column_end - window.column_begin, rows = window.row_end - window.row_begin;
  std::mutex merging;  // sums of integers: the order of merging does not show
  parallel_for(columns * rows, 1, [&](std::size_t begin, std::size_t end) {
    auto worker = make_worker();
    for (std::size_t block = begin; block < end && !stop_requested(); ++block) {
      worker.run_block(window.column_begin + static_cast<std::uint32_t>(block % columns),
                       window.row_begin + static_cast<std::uint32_t>(block / columns));
    }
    const std::scoped_lock lock(merging);
    out.add(worker.counts);
  });
}

// Lists all lights of a window, then shades it; halves of it one after the other where the lists grow too long.
void shade_listed(const ShadingInputs& inputs, const TileParts& parts, const TileWindow& window, ShadingOutputs& out) {
  {
    const PartLists lists(inputs, parts, window);
    out.culling_seconds += lists.busy_seconds();
    // Those of a window whose lists grew too long count as well: they were made.
    out.diffuse.tests += lists.diffuse().tests, out.glossy.tests += lists.glossy().tests;
    out.many.tests += lists.many().tests;
    if (lists.complete()) {
      out.list_bytes = std::max(out.list_bytes, lists.bytes()), ++out.windows;
      return run_blocks(window, out, [&] { return ListWorker(inputs, lists, out); });
    }
  }
  TileWindow first = window, second = window;
  if (window.row_end - window.row_begin > 1) {
    first.row_end = second.row_begin = (window.row_begin + window.row_end) / 2;
  } else {
    first.column_end = second.column_begin = (window.column_begin + window.column_end) / 2;
  }
  shade_listed(inputs, parts, first, out);
  shade_listed(inputs, parts, second, out);
}

}  // namespace

void ShadingCounts::add(const ShadingCounts& more) {
  add_counts(diffuse, more.diffuse), add_counts(glossy, more.glossy), add_counts(many, more.many);
  list_lengths.insert(list_lengths.end(), more.list_lengths.begin(), more.list_lengths.end());
  pixels += more.pixels;
  culling_seconds += more.culling_seconds, shading_seconds += more.shading_seconds;
}

void Radiance::resize(std::size_t pixels) {
  for (Plane3* planes : {&diffuse, &specular})
    for (Plane& plane : *planes) plane.resize(pixels);
}

ShadingOutputs shade(const ShadingInputs& inputs) {
  ShadingOutputs out;
  const std::size_t pixels = inputs.geometry.pixel_count();
  clear(out.radiance.indirect, pixels);
  if (inputs.lobes_apart) clear(out.radiance.from_diffuse, pixels), clear(out.radiance.from_glossy, pixels);
  if (!inputs.many.emitters.empty()) clear(out.radiance.from_many, pixels);
  if (inputs.count_per_pixel) {
    out.lights_listed.assign(pixels, 0.0f);
    out.lights_false.assign(pixels, 0.0f);
  }
  if (inputs.settings.culling == Culling::clustered || inputs.settings.culling == Culling::splatting) {
    const TileParts parts(inputs.geometry, inputs.settings.interleave, inputs.settings.culling);
    out.culling_seconds += parts.busy_seconds();
    shade_listed(inputs, parts, whole_frame(inputs), out);
  } else {
    run_blocks(whole_frame(inputs), out, [&] { return TileWorker(inputs, out); });
  }
  return out;
}

}  // namespace luciole
