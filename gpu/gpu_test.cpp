// SPDX-License-Identifier: Apache-2.0
// Kernels compute, passes are timed, and what goes wrong is said.
#include <array>

#include "gpu/test_device.h"

namespace luciole {
extern const gpu::ShaderCode test_scale;
}

namespace luciole::gpu::test {
namespace {

struct Push {
  std::uint64_t numbers, products;
  std::uint32_t count;
  float factor;
};

constexpr std::uint32_t kCount = 1000;  // is no multiple of a workgroup

std::vector<float> numbers() {
  std::vector<float> n(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) n[i] = static_cast<float>(i);
  return n;
}

// Runs the kernel on kCount numbers, up and down through the device's own memory.
struct Scaling {
  explicit Scaling(Device& device_, std::uint32_t offset = 0)
      : device(device_),
        kernel(make_kernel(device, test_scale, sizeof(Push), {offset})),
        sent(upload_of(device, numbers())),
        in(make_buffer(device, 4 * kCount, BufferUse::device)),
        out(make_buffer(device, 4 * kCount, BufferUse::device)),
        received(make_buffer(device, 4 * kCount, BufferUse::readback)) {}

  Status run(std::uint32_t claimed = kCount) {
    CommandList list = make_list(device);
    list.begin_pass("up");
    list.copy(sent, in, 4 * kCount);
    list.begin_pass("scale");
    list.dispatch(kernel, Push{in.address(), out.address(), claimed, 3.0f}, (claimed + 255) / 256);
    list.begin_pass("down");
    list.copy(out, received, 4 * kCount);
    Status done = list.run();
    passes_ms = list.passes_ms();
    return done;
  }

  Device& device;
  Kernel kernel;
  Buffer sent, in, out, received;
  std::vector<std::pair<std::string, double>> passes_ms;
};

TEST(Kernel, computes_with_push_constants_and_specialisation_constants) {
  const auto device = open_device();
  ASSERT_TRUE(device);
  for (const std::uint32_t offset : {0u, 5u}) {
    Scaling scaling(*device, offset);
    const Status done = scaling.run();
    ASSERT_TRUE(done.has_value()) << done.error().message;
    const auto products = values_in<float>(scaling.received, kCount);
    for (std::uint32_t i = 0; i < kCount; ++i)
      ASSERT_EQ(products[i], 3.0f * static_cast<float>(i) + static_cast<float>(offset));
  }
}

TEST(CommandList, times_each_pass_by_name) {
  const auto device = open_device();
  ASSERT_TRUE(device);
  Scaling scaling(*device);
  ASSERT_TRUE(scaling.run().has_value());
  ASSERT_EQ(scaling.passes_ms.size(), 3u);
  EXPECT_EQ(scaling.passes_ms[1].first, "scale");
  double all = 0;
  for (const auto& [name, ms] : scaling.passes_ms) {
    EXPECT_GE(ms, 0) << name;
    all += ms;
  }
  EXPECT_GT(all, 0);
}

TEST(Device, that_is_lost_says_so_and_stays_lost) {
  DeviceRequest request;
  request.lost_from_submission = 2;
  const auto device = open_device(request);
  ASSERT_TRUE(device);
  Scaling scaling(*device);
  EXPECT_TRUE(scaling.run().has_value());
  EXPECT_FALSE(device->lost());
  for (int i = 0; i < 2; ++i) {
    const Status lost = scaling.run();
    ASSERT_FALSE(lost.has_value());
    EXPECT_NE(lost.error().message.find("the device was lost"), std::string::npos) << lost.error().message;
    EXPECT_TRUE(device->lost());
  }
}

TEST(Buffer, that_does_not_fit_is_refused_as_out_of_memory) {
  const auto device = open_device();
  ASSERT_TRUE(device);
  const Result<Buffer> huge = Buffer::create(*device, std::uint64_t{1} << 50, BufferUse::device);
  ASSERT_FALSE(huge.has_value());
  EXPECT_EQ(huge.error().kind, ErrorKind::out_of_memory) << huge.error().message;
}

TEST(Memory, is_reused) {
  const auto device = open_device();
  ASSERT_TRUE(device);
  const Buffer kept = make_buffer(*device, 1000, BufferUse::upload);
  std::uint64_t first = 0;
  for (int i = 0; i < 100; ++i) {
    const Buffer passing = make_buffer(*device, 1 << 20, BufferUse::upload);
    if (i == 0) first = passing.address();
    EXPECT_EQ(passing.address(), first);
  }
}

// The layers: core, synchronisation and GPU-assisted checks. Each finds the mistake that it is there for.

TEST(Validation, has_nothing_to_say_of_what_is_right) {
  const auto device = open_validated_device();
  ASSERT_TRUE(device);
  Scaling scaling(*device);
  const Status done = scaling.run();
  EXPECT_TRUE(done.has_value()) << done.error().message;
}

TEST(Validation, finds_a_copy_past_the_end) {
  const auto device = open_validated_device();
  ASSERT_TRUE(device);
  const Buffer from = make_buffer(*device, 400, BufferUse::device), to = make_buffer(*device, 200, BufferUse::device);
  CommandList list = make_list(*device);
  list.begin_pass("copy");
  list.copy(from, to, 400);
  const Status done = list.run();
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(done.error().message.rfind("Vulkan validation: ", 0), 0u) << done.error().message;
}

TEST(Validation, finds_writes_without_a_barrier_between_them) {
  const auto device = open_validated_device();
  ASSERT_TRUE(device);
  const Buffer from = make_buffer(*device, 400, BufferUse::device), to = make_buffer(*device, 400, BufferUse::device);
  for (const bool barrier : {true, false}) {
    CommandList list = make_list(*device);
    list.begin_pass("copy twice");
    list.copy(from, to, 400);
    if (barrier) list.barrier();
    list.copy(from, to, 400);
    const Status done = list.run();
    EXPECT_EQ(done.has_value(), barrier);
    if (done) continue;
    EXPECT_NE(done.error().message.find("SYNC-HAZARD"), std::string::npos) << done.error().message;
  }
}

TEST(Validation, finds_a_kernel_that_reads_past_its_buffer) {
  const auto device = open_validated_device();
  ASSERT_TRUE(device);
  Scaling scaling(*device);
  const Status done = scaling.run(kCount + 24);
  ASSERT_FALSE(done.has_value());
  EXPECT_NE(done.error().message.find("out of bounds"), std::string::npos) << done.error().message;
}

}  // namespace
}  // namespace luciole::gpu::test
