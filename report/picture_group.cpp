// SPDX-License-Identifier: Apache-2.0
#include "report/picture_group.h"

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

PictureGroup::PictureGroup(std::string prefix, Image reference)
    : prefix_(std::move(prefix)), reference_(std::move(reference)) {}

Result<PictureGroup> PictureGroup::create(const PageFolder& folder, const std::string& prefix, PagePicture reference,
                                          const ComparisonSettings& display) {
  if (Status status = check_comparable(reference.image); !status) return blamed_on(reference, status.error());
  PageEntry entry = entry_of(reference, prefix + "reference");
  PictureGroup group(prefix, std::move(reference.image));
  group.content.width = group.reference_.width, group.content.height = group.reference_.height;
  group.content.display = display;
  group.content.reference = std::move(entry);
  const Status status = group.write_picture(folder, group.content.reference, group.reference_.colours(""));
  if (!status) return status.error();
  return group;
}

Status PictureGroup::add(const PageFolder& folder, const PagePicture& picture) {
  const Result<MappedComparison> compared = compare_with_maps(picture.image, reference_, content.display);
  if (!compared) return blamed_on(picture, compared.error());
  PageEntry entry = entry_of(picture, prefix_ + "picture-" + std::to_string(content.pictures.size() + 1));
  entry.figures = compared->figures;
  if (Status status = write_picture(folder, entry, picture.image.colours("")); !status) return status;
  const DifferenceMaps& maps = compared->maps;
  if (Status status = write_map(folder, entry.stem + "-error.png", error_colours(maps.relative_error)); !status) {
    return status;
  }
  if (Status status = write_map(folder, entry.stem + "-flip.png", flip_colours(maps.flip)); !status) return status;
  content.pictures.push_back(std::move(entry));
  return Done{};
}

Status PictureGroup::write_picture(const PageFolder& folder, const PageEntry& entry,
                                   const std::vector<Vec3>& radiance) const {
  const ComparisonSettings& display = content.display;
  const std::vector<Vec3> shown = to_display(radiance, display.exposure, display.tone_curve);
  if (Status status = write_map(folder, entry.stem + ".png", shown); !status) return status;
  // The script of the page defines the function.
  return write_text("luciole_pixels(\"" + entry.stem + "\", \"" +
                        linear_pixels_text(radiance, content.width, display.exposure) + "\");\n",
                    folder.file(entry.stem + ".js"));
}

Status PictureGroup::write_map(const PageFolder& folder, const std::string& name,
                               const std::vector<Vec3>& colours) const {
  return write_png(colours, content.width, content.height, folder.file(name));
}

}  // namespace luciole
