// SPDX-License-Identifier: Apache-2.0
// The equations on the device are those of scalar C++, as far as SPIR-V's rules of precision allow.
//
// C++ rounds each operation to within 1/2 unit in the last place. SPIR-V allows 2.5 of them for division, 2 for
// inverse square roots, and roots and divisions made of these ("Precision and Operation of SPIR-V Instructions" of the
// Vulkan specification); sums, products and conversions are exact to 1/2, and a fused multiply-add errs less than its
// two parts. So to first order no chain of operations errs more than 5 times as much as in C++, and how much that is,
// double precision tells.
#include <algorithm>
#include <array>
#include <cmath>

#include "equations/test_support.h"
#include "gpu/test_device.h"

#define LUCIOLE_FN inline
#define LUCIOLE_REAL(literal) static_cast<real>(literal)
#define LUCIOLE_INSTANTIATING_EQUATIONS
namespace luciole::f32 {
#include "equations/equations_probe.h"
}
#undef LUCIOLE_EQUATIONS_PROBE_H
namespace luciole::f64 {
#include "equations/equations_probe.h"
}

namespace luciole {
extern const gpu::ShaderCode equations_probe;
}

namespace luciole::test {
namespace {

constexpr std::size_t kInputs = 16384;
constexpr double kAllowed = 5;  // times the error of C++
constexpr std::size_t kFields = sizeof(f32::ProbeOutput) / sizeof(float), kXi = 0, kStratifiedXi = 1, kTouches = 12;
constexpr std::array<const char*, kFields> kNames = {
    "xi",           "stratified_xi",   "specular",      "diffuse",   "probability",     "range_sq",
    "spheroid_r_u", "fitted_r_w",      "tight_r_u",     "tight_r_w", "box_distance_sq", "exact_distance_sq",
    "touches",      "level_of_detail", "shading_normal"};

std::vector<f32::ProbeInput> random_inputs() {
  Dice dice(67);
  std::vector<f32::ProbeInput> inputs(kInputs);
  for (f32::ProbeInput& input : inputs) {
    const TextbookLobe lobe = random_lobe(dice, 0.05);
    input.incident = rounded(lobe.incident), input.outgoing = rounded(outgoing_direction(dice, lobe));
    input.ggx_alpha = static_cast<float>(lobe.alpha), input.f0 = static_cast<float>(lobe.f0);
    input.index = dice.bits();
  }
  return inputs;
}

template <class Number>
using Fields = std::array<Number, kFields>;

template <class Number, class Output>
Fields<Number> fields_of(const Output& output) {
  static_assert(sizeof(Output) == sizeof(Fields<Number>));
  Fields<Number> fields;
  std::memcpy(fields.data(), &output, sizeof(output));
  return fields;
}

Fields<double> exact(const f32::ProbeInput& input) {
  const f64::ProbeInput wide{widened(input.incident), widened(input.outgoing), input.ggx_alpha, input.f0, input.index};
  return fields_of<double>(f64::probe_equations(wide));
}

std::vector<Fields<float>> on_device(gpu::Device& device, const std::vector<f32::ProbeInput>& inputs) {
  struct Push {
    std::uint64_t inputs, outputs;
    std::uint32_t count, unused;
  };
  namespace t = gpu::test;
  const gpu::Kernel kernel = t::make_kernel(device, equations_probe, sizeof(Push));
  const gpu::Buffer in = t::upload_of(device, inputs);
  const gpu::Buffer out = t::make_buffer(device, inputs.size() * sizeof(Fields<float>), gpu::BufferUse::readback);
  gpu::CommandList list = t::make_list(device);
  list.begin_pass("equations");
  const auto count = static_cast<std::uint32_t>(inputs.size());
  list.dispatch(kernel, Push{in.address(), out.address(), count, 0}, (count + 63) / 64);
  const Status done = list.run();
  EXPECT_TRUE(done.has_value()) << done.error().message;
  return t::values_in<Fields<float>>(out, inputs.size());
}

// Error in units in the last place of the exact value.
double error_ulp(double value, double right) {
  return std::abs(value - right) / std::ldexp(1.0, std::ilogb(std::max(std::abs(right), 1e-30)) - 23);
}

struct Errors {
  double median = 0, p999 = 0, largest = 0;
};

Errors summary(std::vector<double> errors) {
  std::sort(errors.begin(), errors.end());
  const auto at = [&](double share) { return errors[static_cast<std::size_t>(share * double(errors.size() - 1))]; };
  return {at(0.5), at(0.999), errors.back()};
}

// Per field, the errors of C++ and of the device.
struct Comparison {
  std::array<Errors, kFields> scalar, device;
  std::array<std::size_t, kFields> changed_bits{};

  // What the rules allow, also where C++ is exact.
  bool allowed(std::size_t f) const {
    const auto within = [](double found, double scalar_error) {
      return found <= kAllowed * std::max(scalar_error, 0.5);
    };
    return within(device[f].median, scalar[f].median) && within(device[f].p999, scalar[f].p999) &&
           within(device[f].largest, scalar[f].largest);
  }
};

Comparison compare(const std::vector<f32::ProbeInput>& inputs, const std::vector<Fields<float>>& found) {
  std::array<std::vector<double>, kFields> scalar_errors, device_errors;
  Comparison c;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Fields<float> scalar = fields_of<float>(f32::probe_equations(inputs[i]));
    const Fields<double> right = exact(inputs[i]);
    for (std::size_t f = 0; f < kFields; ++f) {
      scalar_errors[f].push_back(error_ulp(scalar[f], right[f]));
      device_errors[f].push_back(error_ulp(found[i][f], right[f]));
      c.changed_bits[f] += std::memcmp(&scalar[f], &found[i][f], sizeof(float)) != 0;
    }
  }
  for (std::size_t f = 0; f < kFields; ++f) {
    c.scalar[f] = summary(std::move(scalar_errors[f]));
    c.device[f] = summary(std::move(device_errors[f]));
  }
  return c;
}

TEST(EquationsOnTheDevice, err_no_more_than_spirv_allows) {
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  const std::vector<f32::ProbeInput> inputs = random_inputs();
  const Comparison c = compare(inputs, on_device(*device, inputs));
  std::printf("subgroups of %u on %s; errors in ulp, scalar | device: median, 99.9 %%, largest\n",
              device->description().subgroup_size, device->description().name.c_str());
  for (std::size_t f = 0; f < kFields; ++f) {
    std::printf("%-18s %9.3g %9.3g %9.3g | %9.3g %9.3g %9.3g | other bits %zu\n", kNames[f], c.scalar[f].median,
                c.scalar[f].p999, c.scalar[f].largest, c.device[f].median, c.device[f].p999, c.device[f].largest,
                c.changed_bits[f]);
    EXPECT_TRUE(f == kTouches || c.allowed(f)) << kNames[f];
  }
  EXPECT_EQ(c.changed_bits[kXi], 0u) << "integers and what is made of them are the same bits everywhere";
  EXPECT_EQ(c.changed_bits[kStratifiedXi], 0u);
  EXPECT_LE(c.changed_bits[kTouches], kInputs / 1000) << "decisions differ only at ties";
}

// An input that is off by the thousandth part of a percent shows in all fields that depend on it.
TEST(EquationsOnTheDevice, of_another_roughness_are_caught) {
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  const std::vector<f32::ProbeInput> inputs = random_inputs();
  std::vector<f32::ProbeInput> other = inputs;
  for (f32::ProbeInput& input : other) input.ggx_alpha *= 1.0001f;
  const Comparison c = compare(inputs, on_device(*device, other));
  for (const std::size_t f : {2u, 4u, 5u, 6u, 7u, 8u, 9u, 10u, 11u}) EXPECT_FALSE(c.allowed(f)) << kNames[f];
}

}  // namespace
}  // namespace luciole::test
