// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "apps/command_line/run_program.h"
#include "image/exr.h"

namespace luciole {
namespace {

// 32 x 8 pixels of one grey.
void write_grey(const fs::path& path, float grey) {
  Image image;
  image.width = 32;
  image.height = 8;
  image.set_colours("", std::vector<Vec3>(256, Vec3(grey, grey, grey)));
  ASSERT_TRUE(write_exr(image, path).has_value());
}

class CompareCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write_grey(folder_ / "a.exr", 0.3f), write_grey(folder_ / "r.exr", 0.25f);
  }
};

TEST_F(CompareCommand, writes_maps_and_tells_their_scales) {
  const Outcome outcome = run({"compare", "a.exr", "r.exr", "--error-map", "out/e.png", "--flip-map", "out/f.png"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.complained;
  EXPECT_NE(outcome.said.find("error map           relative error, logarithmic from 0.001 (black) to 10 (pale yellow)"),
            std::string::npos)
      << outcome.said;
  EXPECT_NE(outcome.said.find("FLIP map            linear from 0 (black) to 1"), std::string::npos) << outcome.said;
  EXPECT_EQ(content(folder_ / "out/e.png").substr(1, 3), "PNG");
  EXPECT_EQ(content(folder_ / "out/f.png").substr(1, 3), "PNG");
  EXPECT_NE(content(folder_ / "out/e.png"), content(folder_ / "out/f.png"));
  EXPECT_EQ(files_in_out(), 2u);
}

TEST_F(CompareCommand, maps_do_not_change_the_figures) {
  const Outcome plain = run({"compare", "a.exr", "r.exr", "--json"});
  const Outcome mapped = run({"compare", "a.exr", "r.exr", "--json", "--error-map", "out/e.png"});
  ASSERT_EQ(plain.exit_code, 0) << plain.complained;
  EXPECT_EQ(plain.said, mapped.said);
  EXPECT_NEAR(nlohmann::json::parse(plain.said)["rmse"].get<double>(), 0.05, 1e-6);
}

TEST_F(CompareCommand, refuses_maps_that_cannot_be_written) {
  EXPECT_REFUSED(2, {"compare", "a.exr", "r.exr", "--error-map", "out/e.exr"});
  EXPECT_REFUSED(2, {"compare", "a.exr", "r.exr", "--error-map", "out/e.png", "--flip-map", "out/e.png"});
  EXPECT_REFUSED(1, {"compare", "a.exr", "r.exr", "--flip-map", "nowhere/f.png"});
  EXPECT_REFUSED(1, {"compare", "a.exr", "nowhere.exr", "--error-map", "out/e.png"});
}

}  // namespace
}  // namespace luciole
