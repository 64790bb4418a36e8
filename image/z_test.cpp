// SPDX-License-Identifier: Apache-2.0
#include "image/z_test.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luciole {
namespace {

constexpr double kRounding = 1.0 / (1 << 20);  // relative, of a float sum: conventions of the test
// Channels whose noise is not well above rounding say nothing about the predicted variance.
constexpr double kLeastNoise = 16 * kRounding;

double z_score(double difference, double variance_of_mean) {
  if (difference == 0) return 0;
  const double z = std::abs(difference) / std::sqrt(variance_of_mean);
  return std::isnan(z) ? std::numeric_limits<double>::infinity() : z;
}

double rounding_variance(double reference) { return kRounding * reference * kRounding * reference; }

// Unbiased, from sums over frames.
double sample_variance(double sum, double squares, double frames) {
  return std::max(0.0, (squares - sum * sum / frames) / (frames - 1));
}

// The values' z-scores, gathered before their limit is known.
struct Scores {
  std::vector<double> z;
  std::vector<std::uint64_t> pixel;
  double ratio_sum = 0;
  std::uint64_t ratio_count = 0;

  void add(double score, std::uint64_t where) {
    z.push_back(score);
    pixel.push_back(where);
  }
};

void score_single_pixel(const EstimatorStatistics& statistics, std::size_t pixel, Scores& scores) {
  const double frames = statistics.frames();
  const Colour& sum = statistics.pixel_sums()[pixel];
  const Colour& squares = statistics.pixel_squares()[pixel];
  const Colour reference = colour_of(statistics.expectation().mean[pixel]);
  const Colour variance = colour_of(statistics.expectation().variance[pixel]);
  for (std::size_t c = 0; c < 3; ++c) {
    scores.add(z_score(sum[c] / frames, variance[c] / frames + rounding_variance(reference[c])), pixel);
    if (variance[c] > 0 && std::sqrt(variance[c]) >= kLeastNoise * std::abs(reference[c])) {
      scores.ratio_sum += sample_variance(sum[c], squares[c], frames) / variance[c];
      scores.ratio_count += 1;
    }
  }
}

// Fourth central moment over the squared second, from sums of powers about the reference. Infinite without noise.
double kurtosis(const EstimatorStatistics::Block& block, std::size_t c, double frames) {
  const double mean = block.sum[c] / frames, square = block.squares[c] / frames;
  const double cube = block.cubes[c] / frames, fourth = block.fourth_powers[c] / frames;
  const double second_central = square - mean * mean;
  if (!(second_central > rounding_variance(block.reference[c]))) return std::numeric_limits<double>::infinity();
  const double mean_sq = mean * mean;
  return (fourth - 4 * mean * cube + 6 * mean_sq * square - 3 * mean_sq * mean_sq) / (second_central * second_central);
}

// The pixels of a block may accept the same lights in the same frames, so the sum of p overstates the independent
// events. k events give an excess kurtosis of frames / k; half of kEnoughAccepted is asked for, as it is an estimate.
bool has_enough_events(const EstimatorStatistics::Block& block, double frames) {
  if (block.accepted * frames < EstimatorStatistics::kEnoughAccepted) return false;
  for (std::size_t c = 0; c < 3; ++c) {
    if (block.random[c] && (kurtosis(block, c, frames) - 3) * EstimatorStatistics::kEnoughAccepted / 2 > frames)
      return false;
  }
  return true;
}

void score_block(const EstimatorStatistics::Block& block, double frames, std::uint64_t where, Scores& scores) {
  for (std::size_t c = 0; c < 3; ++c) {
    const double variance = sample_variance(block.sum[c], block.squares[c], frames);
    scores.add(z_score(block.sum[c] / frames, variance / frames + rounding_variance(block.reference[c])), where);
  }
}

// Each smallest block with dark pixels is stood for by the smallest block around it that has enough events.
void score_blocks(const EstimatorStatistics& statistics, Scores& scores, ZTestReport& report) {
  const auto& levels = statistics.block_levels();
  if (levels.empty()) return;
  const double frames = statistics.frames();
  const std::uint32_t width = statistics.expectation().width;
  std::vector<std::vector<bool>> used;
  for (const auto& level : levels) used.emplace_back(level.blocks.size());
  for (std::size_t smallest = 0; smallest < levels[0].blocks.size(); ++smallest) {
    if (levels[0].blocks[smallest].pixels == 0) continue;
    std::size_t row = smallest / levels[0].columns, column = smallest % levels[0].columns, l = 0;
    const auto index = [&] { return row * levels[l].columns + column; };
    while (l < levels.size() && !has_enough_events(levels[l].blocks[index()], frames)) {
      row /= 2, column /= 2, ++l;
    }
    if (l == levels.size()) {
      report.untested_pixels += levels[0].blocks[smallest].pixels;
    } else if (!used[l][index()]) {
      used[l][index()] = true;
      score_block(levels[l].blocks[index()], frames, (row * width + column) * levels[l].side, scores);
      report.blocks += 1;
    }
  }
}

void judge_values(const Scores& scores, const ZTestLimits& limits, ZTestReport& report) {
  report.values = scores.z.size();
  report.sidak_limit = sidak_limit(std::max<std::uint64_t>(1, report.values), limits.family_error);
  for (std::size_t i = 0; i < scores.z.size(); ++i) {
    report.outside += scores.z[i] > report.sidak_limit ? 1 : 0;
    if (scores.z[i] <= report.largest_deviation) continue;
    report.largest_deviation = scores.z[i];
    report.worst_pixel = scores.pixel[i];
  }
  report.variance_values = scores.ratio_count;
  if (scores.ratio_count > 0) report.variance_ratio = scores.ratio_sum / static_cast<double>(scores.ratio_count);
}

void judge_picture(const EstimatorStatistics& statistics, ZTestReport& report) {
  const double frames = statistics.frames();
  double sum = 0, squares = 0, reference = 0;
  for (const double difference : statistics.picture_differences()) {
    sum += difference;
    squares += difference * difference;
  }
  for (const Vec3& pixel : statistics.expectation().mean) {
    reference += 0.2126 * pixel.x + 0.7152 * pixel.y + 0.0722 * pixel.z;
  }
  reference /= static_cast<double>(statistics.expectation().mean.size());
  const double variance_of_mean = sample_variance(sum, squares, frames) / frames + rounding_variance(reference);
  report.picture_t = std::copysign(z_score(sum / frames, variance_of_mean), sum);
}

std::string reason_of(const ZTestReport& report, const ZTestLimits& limits) {
  if (report.values == 0) return "too few frames: no pixel and no block has enough accepted lights to be tested";
  if (report.largest_deviation > limits.hard_limit) {
    return "a value lies " + std::to_string(report.largest_deviation) + " standard deviations from the reference";
  }
  if (static_cast<double>(report.outside) > limits.share_outside * static_cast<double>(report.values)) {
    return std::to_string(report.outside) + " of " + std::to_string(report.values) + " values lie beyond " +
           std::to_string(report.sidak_limit) + " standard deviations";
  }
  if (!(std::abs(report.picture_t) < limits.picture_limit)) {
    return "the picture's mean is off by t = " + std::to_string(report.picture_t);
  }
  if (!(report.variance_ratio >= limits.lowest_variance_ratio &&
        report.variance_ratio <= limits.highest_variance_ratio)) {
    return "the sampled variance is " + std::to_string(report.variance_ratio) + " times the predicted one";
  }
  return {};
}

}  // namespace

double two_sided_normal_quantile(double tail) {
  // erfc falls from 1 at 0 to the smallest double before 40; bisection ends when the interval stops shrinking.
  double low = 0, high = 40;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    (std::erfc(middle / std::sqrt(2.0)) > tail ? low : high) = middle;
  }
}

double sidak_limit(std::uint64_t values, double family_error) {
  // 1 - (1 - family_error)^(1/values), without cancellation.
  const double each = -std::expm1(std::log1p(-family_error) / static_cast<double>(values));
  return two_sided_normal_quantile(each);
}

ZTestReport image_z_test(const EstimatorStatistics& statistics, const ZTestLimits& limits) {
  ZTestReport report;
  if (statistics.frames() < 2 || statistics.frames() != statistics.planned_frames()) {
    report.reason = "the test needs at least two frames, and all that were planned";
    return report;
  }
  Scores scores;
  for (std::size_t i = 0; i < statistics.pixel_sums().size(); ++i) {
    if (statistics.is_dark(i)) continue;
    score_single_pixel(statistics, i, scores);
    report.single_pixels += 1;
  }
  score_blocks(statistics, scores, report);
  judge_values(scores, limits, report);
  judge_picture(statistics, report);
  report.reason = reason_of(report, limits);
  report.passed = report.reason.empty();
  return report;
}

}  // namespace luciole
