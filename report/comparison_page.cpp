// SPDX-License-Identifier: Apache-2.0
#include "report/comparison_page.h"

#include <cctype>
#include <utility>

#include "image/false_colour.h"
#include "image/output_file.h"
#include "image/png.h"
#include "report/linear_pixels.h"

namespace luciole {
namespace {

PageEntry entry_of(const PagePicture& picture, const std::string& stem) {
  PageEntry entry;
  entry.name = picture.name;
  entry.stem = stem;
  entry.metadata = picture.image.metadata;
  entry.render_time = picture.render_time.empty() ? render_time_of(picture.image.metadata) : picture.render_time;
  return entry;
}

Error blamed_on(const PagePicture& picture, const Error& error) {
  return {error.kind, picture.name + ": " + error.message};
}

}  // namespace

std::string render_time_of(const std::map<std::string, std::string>& metadata) {
  for (const auto& [name, value] : metadata) {
    std::string letters;
    for (const unsigned char letter : name) {
      if (std::isalnum(letter)) letters += static_cast<char>(std::tolower(letter));
    }
    if (letters.find("rendertime") == std::string::npos || value.empty()) continue;
    const bool bare = value.find_first_not_of("0123456789.") == std::string::npos;
    return bare ? value + " s" : value;
  }
  return {};
}

ComparisonPage::ComparisonPage(PageFolder folder, Image reference)
    : folder_(std::move(folder)), reference_(std::move(reference)) {}

Result<ComparisonPage> ComparisonPage::create(const std::filesystem::path& folder, PagePicture reference,
                                              const ComparisonSettings& display, const std::string& made_by) {
  if (Status status = check_comparable(reference.image); !status) return blamed_on(reference, status.error());
  Result<PageFolder> made = PageFolder::create(folder);
  if (!made) return made.error();
  const std::uint32_t width = reference.image.width, height = reference.image.height;
  PageEntry entry = entry_of(reference, "reference");
  ComparisonPage page(std::move(*made), std::move(reference.image));
  page.content_ = {width, height, display, made_by, std::move(entry), {}};
  Status status = page.write_picture(page.content_.reference, page.reference_.colours(""));
  if (!status) return status.error();
  return page;
}

Status ComparisonPage::add(const PagePicture& picture) {
  const Result<MappedComparison> compared = compare_with_maps(picture.image, reference_, content_.display);
  if (!compared) return blamed_on(picture, compared.error());
  PageEntry entry = entry_of(picture, "picture-" + std::to_string(content_.pictures.size() + 1));
  entry.figures = compared->figures;
  if (Status status = write_picture(entry, picture.image.colours("")); !status) return status;
  if (Status status = write_map(entry.stem + "-error.png", error_colours(compared->maps.relative_error)); !status) {
    return status;
  }
  if (Status status = write_map(entry.stem + "-flip.png", flip_colours(compared->maps.flip)); !status) return status;
  content_.pictures.push_back(std::move(entry));
  return Done{};
}

Status ComparisonPage::write_picture(const PageEntry& entry, const std::vector<Vec3>& radiance) const {
  const ComparisonSettings& display = content_.display;
  if (Status status = write_map(entry.stem + ".png", to_display(radiance, display.exposure, display.tone_curve));
      !status) {
    return status;
  }
  // The script of the page defines the function.
  return write_text("luciole_pixels(\"" + entry.stem + "\", \"" +
                        linear_pixels_text(radiance, content_.width, display.exposure) + "\");\n",
                    folder_.file(entry.stem + ".js"));
}

Status ComparisonPage::write_map(const std::string& name, const std::vector<Vec3>& colours) const {
  return write_png(colours, content_.width, content_.height, folder_.file(name));
}

Status ComparisonPage::finish() {
  if (Status status = write_text(page_html(content_), folder_.file("index.html")); !status) return status;
  return folder_.commit();
}

}  // namespace luciole
