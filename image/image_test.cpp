// SPDX-License-Identifier: Apache-2.0
#include "image/image.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "image/output_file.h"

namespace luciole {
namespace {

const std::filesystem::path kScratch = LUCIOLE_SCRATCH_DIR;

Image two_pixels() {
  Image image;
  image.width = 2;
  image.height = 1;
  image.set_colours("", {Vec3(1, 2, 3), Vec3(4, 5, 6)});
  image.set_vectors("normal", {Vec3(0, 0, 1), Vec3(0, 1, 0)});
  image.set_values("depth", {7, 8});
  return image;
}

TEST(Image, gives_back_each_kind_of_layer) {
  const Image image = two_pixels();
  EXPECT_EQ(image.channels.size(), 7u);
  EXPECT_EQ(image.colours("")[1].y, 5);
  EXPECT_EQ(image.colours("normal")[0].z, 1);
  EXPECT_EQ(image.colours("depth")[1].x, 8);
  EXPECT_EQ(image.colours("depth")[1].z, 8);
}

TEST(Image, a_missing_or_incomplete_layer_is_not_there) {
  Image image = two_pixels();
  EXPECT_TRUE(image.has_layer("normal"));
  EXPECT_FALSE(image.has_layer("albedo"));
  image.channels.erase("normal.Y");
  EXPECT_FALSE(image.has_layer("normal"));
  image.channels["depth.V"].pop_back();
  EXPECT_TRUE(image.colours("depth").empty());
}

TEST(OutputFile, leaves_nothing_when_it_is_not_committed) {
  const auto path = kScratch / "abandoned.txt";
  std::filesystem::path partial;
  {
    auto file = OutputFile::create(path);
    ASSERT_TRUE(file.has_value());
    std::fputs("half", file->stream());
    for (const auto& entry : std::filesystem::directory_iterator(kScratch)) {
      if (entry.path().string().starts_with((path.string() + ".partial"))) partial = entry.path();
    }
    EXPECT_FALSE(partial.empty());
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_FALSE(std::filesystem::exists(partial));
}

TEST(OutputFile, replaces_the_old_file_only_when_complete) {
  const auto path = kScratch / "replaced.txt";
  std::ofstream(path) << "old";
  auto file = OutputFile::create(path);
  ASSERT_TRUE(file.has_value());
  std::fputs("new", file->stream());
  std::string text;
  std::ifstream(path) >> text;
  EXPECT_EQ(text, "old");
  ASSERT_TRUE(file->commit().has_value());
  std::ifstream(path) >> text;
  EXPECT_EQ(text, "new");
}

TEST(OutputFile, refuses_folders_devices_and_missing_folders_with_one_sentence) {
  for (const char* path : {"/dev/null", "/", "/no/such/folder/file.txt", LUCIOLE_SCRATCH_DIR}) {
    const auto file = OutputFile::create(path);
    ASSERT_FALSE(file.has_value()) << path;
    EXPECT_EQ(file.error().message.find('\n'), std::string::npos);
    EXPECT_NE(file.error().message.find(path), std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::is_regular_file("/dev/null"));
}

TEST(OutputFile, a_link_stays_a_link) {
  const auto target = kScratch / "link_target.txt", link = kScratch / "link.txt";
  std::filesystem::remove(link);
  std::ofstream(target) << "old";
  std::filesystem::create_symlink(target, link);
  auto file = OutputFile::create(link);
  ASSERT_TRUE(file.has_value());
  ASSERT_TRUE(file->commit().has_value());
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(std::filesystem::file_size(target), 0u);
}

}  // namespace
}  // namespace luciole
