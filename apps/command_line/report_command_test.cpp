// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/run_program.h"
#include "image/exr.h"

namespace luciole {
namespace {

void write_grey(const fs::path& path, std::uint32_t width, float grey) {
  Image image;
  image.width = width;
  image.height = 8;
  image.set_colours("", std::vector<Vec3>(std::size_t(width) * 8, Vec3(grey, grey, grey)));
  ASSERT_TRUE(write_exr(image, path).has_value());
}

class ReportCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    fs::create_directories(folder_ / "other");
    for (const char* name : {"a.exr", "other/a.exr", "<b>\"&.exr"}) write_grey(folder_ / name, 32, 0.3f);
    write_grey(folder_ / "r.exr", 32, 0.25f);
    write_grey(folder_ / "wide.exr", 33, 0.25f);
  }

  static std::vector<std::string> report(const std::string& picture, const std::string& output) {
    return {"report", "--compare", picture, "--reference", "r.exr", "-o", output};
  }
};

TEST_F(ReportCommand, makes_a_page_of_files_with_any_names) {
  const Outcome outcome =
      run({"report", "--compare", "a.exr", "other/a.exr", "<b>\"&.exr", "--reference", "r.exr", "-o", "out/page/"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.complained;
  EXPECT_EQ(outcome.said + outcome.complained, "");
  EXPECT_EQ(files_in_out(), 1u);
  const std::string page = content(folder_ / "out/page/index.html");
  EXPECT_NE(page.find("<h3>a.exr</h3>"), std::string::npos);
  EXPECT_NE(page.find("<h3>other/a.exr</h3>"), std::string::npos);
  EXPECT_NE(page.find("<h3>&lt;b&gt;&quot;&amp;.exr</h3>"), std::string::npos);
  EXPECT_EQ(page.find("<b>"), std::string::npos);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "out/page"), {}), 3 * 4 + 2 + 1);
}

TEST_F(ReportCommand, takes_times_from_statistics_beside_a_picture_and_from_nothing_else) {
  std::ofstream(folder_ / "a.json") << R"({"frame_ms": 12.5, "settings": {}, "processor": "any"})";
  std::ofstream(folder_ / "other/a.json") << R"({"frame_ms": 99})";
  std::ofstream(folder_ / "r.json") << "{";
  ASSERT_EQ(run({"report", "--compare", "a.exr", "other/a.exr", "--reference", "r.exr", "-o", "out/page"}).exit_code,
            0);
  const std::string page = content(folder_ / "out/page/index.html");
  EXPECT_NE(page.find("<td>12.5 ms a frame</td>"), std::string::npos);
  EXPECT_EQ(page.find("99 ms"), std::string::npos);
}

TEST_F(ReportCommand, exposure_and_tone_curve_reach_the_page) {
  std::vector<std::string> words = report("a.exr", "out/page");
  words.insert(words.end(), {"--exposure", "2.5", "--tone-curve", "linear"});
  ASSERT_EQ(run(words).exit_code, 0);
  const std::string page = content(folder_ / "out/page/index.html");
  EXPECT_NE(page.find("data-exposure=\"2.5\" data-tone-curve=\"linear\""), std::string::npos);
}

TEST_F(ReportCommand, starts_at_the_exposure_that_the_reference_was_made_for) {
  Result<Image> reference = read_exr(folder_ / "r.exr");
  ASSERT_TRUE(reference.has_value());
  reference->metadata["luciole.exposure"] = "0.125";
  ASSERT_TRUE(write_exr(*reference, folder_ / "r.exr").has_value());
  ASSERT_EQ(run(report("a.exr", "out/page")).exit_code, 0);
  EXPECT_NE(content(folder_ / "out/page/index.html").find("data-exposure=\"0.125\""), std::string::npos);
  reference->metadata["luciole.exposure"] = "none";
  ASSERT_TRUE(write_exr(*reference, folder_ / "r.exr").has_value());
  ASSERT_EQ(run(report("a.exr", "out/page")).exit_code, 0);
  EXPECT_NE(content(folder_ / "out/page/index.html").find("data-exposure=\"1\""), std::string::npos);
}

TEST_F(ReportCommand, misuse_ends_with_exit_code_2) {
  EXPECT_REFUSED(2, {"report", "--compare", "a.exr", "-o", "out/page"});
  EXPECT_REFUSED(2, {"report", "--reference", "r.exr", "-o", "out/page"});
  EXPECT_REFUSED(2, {"report", "--compare", "a.exr", "--reference", "r.exr"});
  EXPECT_REFUSED(2, {"report", "--compare", "a.exr", "--reference", "r.exr", "-o", ""});
  EXPECT_REFUSED(2, {"report", "-o", "out/page"});
  EXPECT_REFUSED(2, {"report", "--figures", "f.json", "--reference", "r.exr", "-o", "out/page"});
  EXPECT_REFUSED(2, {"report", "--compare", "a.exr", "--reference", "r.exr", "-o", "out/page", "--exposure", "0"});
  EXPECT_REFUSED(2, {"report", "--compare", "a.exr", "--reference", "r.exr", "-o", "out/page", "--tone-curve", "x"});
}

TEST_F(ReportCommand, bad_files_and_folders_end_with_exit_code_1_and_no_page) {
  std::ofstream(folder_ / "text.exr") << "no picture";
  std::ofstream(folder_ / "file") << "no folder";
  EXPECT_REFUSED(1, report("nowhere.exr", "out/page"));
  EXPECT_REFUSED(1, {"report", "--figures", "nowhere.json", "-o", "out/page"});
  EXPECT_REFUSED(1, report("text.exr", "out/page"));
  EXPECT_REFUSED(1, report("wide.exr", "out/page"));
  EXPECT_REFUSED(1, report("a.exr", "file"));
  EXPECT_REFUSED(1, report("a.exr", "out/no/page"));
  EXPECT_REFUSED(1, {"report", "--compare", "a.exr", "wide.exr", "--reference", "r.exr", "-o", "out/page"});
  EXPECT_REFUSED(1, {"report", "--compare", "a.exr", "--reference", "nowhere.exr", "-o", "out/page"});
  EXPECT_EQ(content(folder_ / "file"), "no folder");
}

}  // namespace
}  // namespace luciole
