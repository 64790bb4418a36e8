// SPDX-License-Identifier: Apache-2.0
#include "real_time/composition/device_tone_curve_pass.h"

#include <array>
#include <cstring>

namespace luciole {

extern const gpu::ShaderCode tone_curve;

Result<DeviceToneCurvePass> DeviceToneCurvePass::create(gpu::Device& device) {
  DeviceToneCurvePass pass;
  Result<gpu::Kernel> kernel = gpu::Kernel::create(device, tone_curve, sizeof(ToneCurvePush));
  if (!kernel) return kernel.error();
  const std::array<float, kCodeEdges> edges = srgb_code_edges();
  Result<gpu::Buffer> sent = gpu::Buffer::create(device, sizeof(edges), gpu::BufferUse::upload);
  if (!sent) return sent.error();
  std::memcpy(sent->as<void>(), edges.data(), sizeof(edges));
  Result<gpu::Buffer> there = gpu::Buffer::create(device, sizeof(edges), gpu::BufferUse::device);
  if (!there) return there.error();
  Result<gpu::CommandList> list = gpu::CommandList::create(device);
  if (!list) return list.error();
  list->begin_pass("transfer");
  list->copy(*sent, *there, sizeof(edges));
  if (Status done = list->run(); !done) return done.error();
  pass.kernel_ = std::move(*kernel), pass.edges_ = std::move(*there);
  return pass;
}

void DeviceToneCurvePass::record(gpu::CommandList& list, const gpu::Buffer& picture, const gpu::Buffer& codes,
                                 std::uint32_t width, std::uint32_t height, float exposure, ToneCurve curve) const {
  ToneCurvePush push{};
  push.picture = picture.address(), push.codes = codes.address(), push.edges = edges_.address();
  push.exposure = exposure;
  push.curve = curve == ToneCurve::pbr_neutral ? kPbrNeutralCurve : kLinearCurve;
  push.width = width, push.height = height;
  list.dispatch(kernel_, push, (width + kPictureGroupColumns - 1) / kPictureGroupColumns,
                (height + kPictureGroupRows - 1) / kPictureGroupRows);
}

}  // namespace luciole
