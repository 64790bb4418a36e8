// SPDX-License-Identifier: Apache-2.0
#include "report/figure_pages.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "image/exr.h"
#include "report/figure_sections.h"
#include "report/light_map.h"
#include "report/plot_svg.h"

namespace luciole {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFigure = R"json({
 "name": "th17-fig0", "paper": "TH17", "paper_title": "A <paper>", "figure": "Figure 0", "title": "Bounds", "says": "so.",
 "stands_in": ["a room"], "differs": [], "missing": [], "quick": false, "commands": ["luciole render 'a<b'"],
 "machine": {"processor": "any", "threads": 2},
 "tables": [{"title": "Counts", "unit": "", "note": "", "row_title": "scene", "columns": ["a", "b"], "has_paper": true,
  "rows": [{"name": "ring", "cells": [{"ours": 10.0, "paper": 5.0, "ratio": 2.0, "reason": ""},
                                      {"ours": null, "paper": 7.0, "ratio": null, "reason": "there is none"}]}]}],
 "plots": [{"title": "Cost", "x_title": "lights", "y_title": "ms", "note": "",
  "series": [{"name": "clamped", "points": [[1024, 1], [65536, 64]]}, {"name": "stochastic", "points": [[1024, 1], [65536, 8]]}],
  "laws": [{"name": "stochastic: law", "points": [[1024, 1.1], [65536, 7]]}]}],
 "claims": [{"text": "fewer", "held": false, "kept": 1, "of": 2, "low": 0.05, "high": 0.2, "worst": "ring", "at_least": null,
             "at_most": 0.1, "paper": [0.05, 0.08], "of_time": false, "note": ""}],
 "comparisons": [{"title": "one", "exposure": 2, "reference": {"name": "reference", "file": "r.exr"},
                  "pictures": [{"name": "ours", "file": "a.exr", "time": "5 ms"}]},
                 {"title": "two", "exposure": 1, "reference": {"name": "reference", "file": "r.exr"},
                  "pictures": [{"name": "theirs", "file": "r.exr", "time": ""}]}],
 "maps": [{"title": "spheroid", "file": "lights.exr"}]
})json";

std::string text_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class FigurePage : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(LUCIOLE_SCRATCH_DIR) / "figures" / testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "site");
    write_picture("a.exr", 0.5f), write_picture("r.exr", 0.25f), write_picture("lights.exr", 0.25f);
    std::ofstream(folder_ / "figure.json") << kFigure;
  }

  void write_picture(const char* name, float value) const {
    Image image;
    image.width = 8, image.height = 4;
    image.set_colours("", std::vector<Vec3>(32, Vec3(value, value, value)));
    image.set_values("lights_listed", std::vector<float>(32, 100)),
        image.set_values("lights_false", std::vector<float>(32, 50));
    ASSERT_TRUE(write_exr(image, folder_ / name).has_value());
  }

  Result<Figure> read_with(const std::string& what, const std::string& instead) const {
    std::string text = kFigure;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    std::ofstream(folder_ / "changed.json") << text.replace(at, what.size(), instead);
    return read_figure(folder_ / "changed.json");
  }

  fs::path folder_;
};

TEST_F(FigurePage, every_file_that_it_asks_for_exists) {
  const Result<Figure> figure = read_figure(folder_ / "figure.json");
  ASSERT_TRUE(figure.has_value()) << figure.error().message;
  ASSERT_TRUE(write_figure_page(*figure, folder_ / "site", "luciole 1.2.3").has_value());
  ASSERT_TRUE(write_figure_index({*figure}, folder_ / "site", "luciole 1.2.3").has_value());
  const std::regex wanted("(src|data-pixels|href)=\"([^\"]*)\"");
  std::set<std::string> files;
  for (const char* name : {"index.html", "th17-fig0/index.html"}) {
    const fs::path page = folder_ / "site" / name;
    const std::string text = text_of(page);
    EXPECT_EQ(text.find("http"), std::string::npos);  // no network
    for (std::sregex_iterator found(text.begin(), text.end(), wanted), end; found != end; ++found) {
      const std::string file = (*found)[2].str() + ((*found)[1] == "data-pixels" ? ".js" : "");
      if (file.starts_with("data:")) continue;
      EXPECT_TRUE(fs::exists(page.parent_path() / file)) << file;
      files.insert(file);
    }
  }
  EXPECT_EQ(files.count("group-2-picture-1-error.png") + files.count("map-1.png") + files.count("th17-fig0/index.html"),
            3u);
}

TEST_F(FigurePage, shows_ours_beside_the_papers_and_says_what_was_not_held) {
  const Result<Figure> figure = read_figure(folder_ / "figure.json");
  ASSERT_TRUE(figure.has_value());
  ASSERT_TRUE(write_figure_page(*figure, folder_ / "site", "luciole").has_value());
  const std::string page = text_of(folder_ / "site/th17-fig0/index.html");
  for (const char* part :
       {"<b>10.00</b> <span class=\"paper\">5.00</span> <span class=\"ratio\">×2.00</span>",
        "<b>–</b> <span class=\"paper\">7.00</span>", "there is none.", "not held (1 of 2)", "worst: ring",
        "at most 0.100", "0.050 to 0.200", "A &lt;paper&gt;", "a&lt;b", "stochastic: law"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

TEST_F(FigurePage, faults_of_a_file_are_named) {
  const auto complaint = [&](const char* what, const char* instead) {
    const Result<Figure> read = read_with(what, instead);
    return read.has_value() ? "" : read.error().message;
  };
  EXPECT_NE(complaint("\"held\": false,", "").find("held"), std::string::npos);
  EXPECT_NE(complaint("[1024, 1]", "[0, 1]").find("logarithmic"), std::string::npos);
  EXPECT_NE(complaint("[\"a\", \"b\"]", "[\"a\"]").find("as long as 'columns'"), std::string::npos);
  EXPECT_NE(complaint("th17-fig0", "../th17").find("'name'"), std::string::npos);
  EXPECT_NE(complaint("{", "").find("no figure of ./do reproduce"), std::string::npos);
  EXPECT_FALSE(read_figure(folder_ / "nowhere.json").has_value());
  Result<Figure> lost = read_with("a.exr", "lost.exr");
  ASSERT_TRUE(lost.has_value());
  EXPECT_FALSE(write_figure_page(*lost, folder_ / "site", "luciole").has_value());
  EXPECT_FALSE(fs::exists(folder_ / "site/th17-fig0"));
}

TEST(LightMap, hue_is_the_share_in_vain_and_brightness_the_number) {
  EXPECT_EQ(light_colour(0, 0).z, 0);
  EXPECT_EQ(light_colour(256, 0).z, 1);  // blue: none in vain
  EXPECT_EQ(light_colour(256, 0).x, 0);
  EXPECT_EQ(light_colour(256, 128).y, 1);  // green: half of them
  EXPECT_EQ(light_colour(512, 512).x, 1);  // red: all; no brighter than white
  EXPECT_EQ(light_colour(64, 64).x, 0.25f);
}

TEST(Plot, marks_lie_within_the_axis_and_short_axes_get_more) {
  EXPECT_EQ(log_ticks(0.5, 2000), (std::vector<double>{1, 10, 100, 1000}));
  EXPECT_EQ(log_ticks(3, 60), (std::vector<double>{5, 10, 20, 50}));
}

// A cost that grows with its lights rises by as many decades as it goes to the right.
TEST(Plot, a_curve_lies_where_its_values_are) {
  FigurePlot plot;
  plot.series = {{"a", {{1, 1}, {10, 10}, {100, 100}}}};
  const std::string text = plot_figure(plot);
  const std::regex circle("cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"");
  std::vector<std::pair<double, double>> places;
  for (std::sregex_iterator found(text.begin(), text.end(), circle), end; found != end; ++found) {
    places.emplace_back(std::stod((*found)[1]), std::stod((*found)[2]));
  }
  ASSERT_EQ(places.size(), 3u);
  EXPECT_NEAR(places[2].first - places[1].first, places[1].first - places[0].first, 0.11);  // printed to a tenth
  EXPECT_NEAR(places[2].second - places[1].second, places[1].second - places[0].second, 0.11);
  EXPECT_LT(places[2].second, places[0].second);  // up is less in SVG
  EXPECT_TRUE(plot_figure({}).empty());
}

}  // namespace
}  // namespace luciole
