// SPDX-License-Identifier: Apache-2.0
#include "image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace luciole {
namespace {

Image picture(std::uint32_t width, std::uint32_t height, const std::vector<Vec3>& pixels) {
  Image image;
  image.width = width;
  image.height = height;
  image.set_colours("", pixels);
  return image;
}

// r = (1, 2, 3 | 4, 2, 0), mean 2; x differs by .5 in the first value and by -1 in the fourth.
// relMSE: denominators r^2 + .01 * 4 = 1.04 and 16.04.
TEST(Compare, agrees_with_figures_worked_out_by_hand) {
  const Image reference = picture(2, 1, {Vec3(1, 2, 3), Vec3(4, 2, 0)});
  const Image other = picture(2, 1, {Vec3(1.5f, 2, 3), Vec3(3, 2, 0)});
  const auto result = compare(other, reference);
  ASSERT_TRUE(result.has_value());
  EXPECT_NEAR(result->rmse, std::sqrt(1.25 / 6), 1e-12);
  EXPECT_NEAR(result->display_rmse, 0, 1e-12);  // white on white, and black on black
  ComparisonSettings dark;
  dark.exposure = 0.25f;  // .375 against .25, .75 against 1
  EXPECT_NEAR(compare(other, reference, dark)->display_rmse, std::sqrt((0.125 * 0.125 + 0.25 * 0.25) / 6), 1e-12);
  EXPECT_NEAR(result->relmse, (0.25 / 1.04 + 1 / 16.04) / 6, 1e-12);
  EXPECT_NEAR(result->largest_difference, 1, 1e-12);
  EXPECT_NEAR(result->mean_ratio, 11.5 / 12, 1e-12);
  EXPECT_GT(result->flip, 0);
}

TEST(Compare, maps_have_the_figures_as_their_means_and_show_where_the_error_is) {
  const Image reference = picture(2, 1, {Vec3(1, 2, 3), Vec3(4, 2, 0)});
  const Image other = picture(2, 1, {Vec3(1.5f, 2, 3), Vec3(3, 2, 0)});
  const auto result = compare_with_maps(other, reference);
  ASSERT_TRUE(result.has_value());
  const std::vector<float>& errors = result->maps.relative_error;
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NEAR(errors[0], std::sqrt(0.25 / 1.04 / 3), 1e-6);
  EXPECT_NEAR(errors[1], std::sqrt(1 / 16.04 / 3), 1e-6);
  EXPECT_NEAR((errors[0] * errors[0] + errors[1] * errors[1]) / 2, result->figures.relmse, 1e-6);
  ASSERT_EQ(result->maps.flip.size(), 2u);
  EXPECT_NEAR((result->maps.flip[0] + result->maps.flip[1]) / 2, result->figures.flip, 1e-6);
}

TEST(Compare, equal_pictures_differ_by_nothing_even_if_black) {
  for (const Vec3 pixel : {Vec3(0.2f, 0.4f, 9), Vec3(0, 0, 0)}) {
    const Image image = picture(1, 1, {pixel});
    const auto result = compare(image, image);
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->rmse, 0);
    EXPECT_EQ(result->relmse, 0);
    EXPECT_EQ(result->flip, 0);
    EXPECT_EQ(result->mean_ratio, 1);
  }
}

TEST(Compare, is_infinite_against_black_where_it_divides) {
  const auto result = compare(picture(1, 1, {Vec3(1, 1, 1)}), picture(1, 1, {Vec3(0, 0, 0)}));
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(std::isinf(result->relmse));
  EXPECT_TRUE(std::isinf(result->mean_ratio));
  EXPECT_EQ(result->rmse, 1);
}

TEST(Compare, refuses_what_cannot_be_compared_with_one_sentence) {
  const Image small = picture(1, 1, {Vec3(1, 1, 1)});
  const Image wide = picture(2, 1, {Vec3(1, 1, 1), Vec3(1, 1, 1)});
  const Image broken = picture(1, 1, {Vec3(1, std::nanf(""), 1)});
  Image colourless = small;
  colourless.channels.erase("B");
  const auto sizes = compare(small, wide);
  ASSERT_FALSE(sizes.has_value());
  EXPECT_NE(sizes.error().message.find("1x1 and 2x1"), std::string::npos);
  EXPECT_FALSE(compare(broken, small).has_value());
  EXPECT_FALSE(compare(small, colourless).has_value());
}

}  // namespace
}  // namespace luciole
