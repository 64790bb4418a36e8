// SPDX-License-Identifier: Apache-2.0
#include "report/comparison_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "report/html.h"

namespace luciole {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

PagePicture flat_picture(const std::string& name, float value, std::map<std::string, std::string> metadata = {}) {
  PagePicture picture;
  picture.name = name;
  picture.image.width = 4;
  picture.image.height = 3;
  picture.image.set_colours("", std::vector<Vec3>(12, Vec3(value, value, value)));
  picture.image.metadata = std::move(metadata);
  return picture;
}

// What the text asks the browser to load from its folder, by src of images and by the pixels' names.
std::set<std::string> files_asked_for(const std::string& page) {
  std::set<std::string> files;
  const std::regex wanted("(src|data-pixels)=\"([^\"]*)\"");
  for (std::sregex_iterator found(page.begin(), page.end(), wanted), end; found != end; ++found) {
    files.insert((*found)[1] == "src" ? (*found)[2].str() : (*found)[2].str() + ".js");
  }
  return files;
}

class Page : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(LUCIOLE_SCRATCH_DIR) / "pages" / testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }

  // The text of a page of one picture, or why there is none.
  Result<std::string> page_of(const PagePicture& picture, const PagePicture& reference) {
    Result<ComparisonPage> page = ComparisonPage::create(folder_ / "page", reference, {}, "luciole 1.2.3");
    if (!page) return page.error();
    if (Status status = page->add(picture); !status) return status.error();
    if (Status status = page->finish(); !status) return status.error();
    return text_of(folder_ / "page/index.html");
  }

  std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
  }

  fs::path folder_;
};

TEST_F(Page, every_file_that_it_asks_for_exists_and_no_other) {
  const Result<std::string> text = page_of(flat_picture("a.exr", 0.5f), flat_picture("r.exr", 0.25f));
  ASSERT_TRUE(text.has_value()) << text.error().message;
  const std::set<std::string> files = files_asked_for(*text);
  EXPECT_EQ(files, (std::set<std::string>{"picture-1.png", "picture-1.js", "picture-1-error.png", "picture-1-flip.png",
                                          "reference.png", "reference.js"}));
  for (const std::string& file : files) EXPECT_GT(fs::file_size(folder_ / "page" / file), 40u) << file;
  EXPECT_EQ(files_in(folder_ / "page"), files.size() + 1);
  EXPECT_EQ(text->find("http"), std::string::npos);  // no network
  EXPECT_NE(text->find("luciole 1.2.3"), std::string::npos);
}

TEST_F(Page, hostile_names_and_metadata_are_text_and_nothing_else) {
  const std::string name = "<b>\"&'.exr";
  const Result<std::string> text = page_of(flat_picture(name, 1, {{"<i>", "</td><script>alert(1)</script>\x01"}}),
                                           flat_picture("</title><b>", 0.25f));
  ASSERT_TRUE(text.has_value()) << text.error().message;
  EXPECT_NE(text->find("&lt;b&gt;&quot;&amp;&#39;.exr"), std::string::npos);
  for (const char* hostile : {"<b>", "<i>", "alert(1)</script>", "\x01"}) {
    EXPECT_EQ(text->find(hostile), std::string::npos) << hostile;
  }
  // The page's own script, and no other.
  const std::regex script("<script");
  EXPECT_EQ(std::distance(std::sregex_iterator(text->begin(), text->end(), script), {}), 1);
}

TEST_F(Page, tells_the_figures_the_times_and_the_settings_that_differ) {
  const Result<std::string> text =
      page_of(flat_picture("a.exr", 0.5f, {{"renderTimeSeconds", "12.5"}, {"spp", "16"}, {"size", "4x3"}}),
              flat_picture("r.exr", 0.25f, {{"spp", "1024"}, {"size", "4x3"}}));
  ASSERT_TRUE(text.has_value()) << text.error().message;
  // relMSE: .25^2 / (1.01 * .25^2).
  for (const char* part : {"<td>0.9901</td>", "<td>0.25</td>", "<td>2</td>", "<td>12.5 s</td>",
                           "<th scope=\"row\">spp</th><td>16</td><td>1024</td>", "<dt>size</dt><dd>4x3</dd>"}) {
    EXPECT_NE(text->find(part), std::string::npos) << part;
  }
}

TEST_F(Page, what_cannot_be_compared_leaves_nothing_behind) {
  PagePicture narrow = flat_picture("narrow.exr", 1);
  narrow.image.width = 3;
  narrow.image.set_colours("", std::vector<Vec3>(9, Vec3(1, 1, 1)));
  const PagePicture broken = flat_picture("broken.exr", std::nanf("")), right = flat_picture("right.exr", 1);
  const Result<std::string> sizes = page_of(narrow, right), values = page_of(right, broken);
  ASSERT_FALSE(sizes.has_value());
  EXPECT_NE(sizes.error().message.find("narrow.exr: "), std::string::npos) << sizes.error().message;
  ASSERT_FALSE(values.has_value());
  EXPECT_NE(values.error().message.find("broken.exr: "), std::string::npos) << values.error().message;
  EXPECT_EQ(files_in(folder_), 0u);
}

TEST_F(Page, a_folder_that_is_there_keeps_its_other_files_and_a_file_is_refused) {
  fs::create_directories(folder_ / "page");
  std::ofstream(folder_ / "page/notes.txt") << "mine";
  std::ofstream(folder_ / "page/index.html") << "old";
  const Result<std::string> text = page_of(flat_picture("a.exr", 0.5f), flat_picture("r.exr", 0.25f));
  ASSERT_TRUE(text.has_value()) << text.error().message;
  EXPECT_NE(*text, "old");
  EXPECT_EQ(text_of(folder_ / "page/notes.txt"), "mine");
  EXPECT_EQ(files_in(folder_ / "page"), 8u);
  std::ofstream(folder_ / "file") << "mine";
  EXPECT_FALSE(PageFolder::create(folder_ / "file").has_value());
  EXPECT_FALSE(PageFolder::create(folder_ / "no/page").has_value());
  EXPECT_EQ(text_of(folder_ / "file"), "mine");
}

TEST(RenderTime, is_found_under_the_names_that_renderers_give_it) {
  EXPECT_EQ(render_time_of({{"RenderTime", "00:01.25"}}), "00:01.25");
  EXPECT_EQ(render_time_of({{"a", "1"}, {"cycles.ViewLayer.render_time", "00:01.25"}}), "00:01.25");
  EXPECT_EQ(render_time_of({{"renderTimeSeconds", "7.5"}}), "7.5 s");
  EXPECT_EQ(render_time_of({{"time", "7.5"}, {"samples", "4"}}), "");
}

TEST(Html, long_values_are_cut_between_characters) {
  EXPECT_EQ(shortened("abc", 3), "abc");
  EXPECT_EQ(shortened("abcd", 3), "abc...");
  EXPECT_EQ(shortened("a\xc3\xa4z", 2), "a...");  // a-umlaut has two bytes
}

}  // namespace
}  // namespace luciole
