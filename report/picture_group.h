// SPDX-License-Identifier: Apache-2.0
// A reference and the pictures that are held against it, on their way to a page: only two are in memory.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "image/image.h"
#include "report/page_folder.h"
#include "report/page_html.h"

namespace luciole {

struct PagePicture {
  std::string name;  // as the reader is to know it
  Image image;
  std::string render_time;  // "12.5 s"; empty: what the metadata say
};

class PictureGroup {
 public:
  // Writes the reference's files. `prefix` begins the names of all files of the group.
  static Result<PictureGroup> create(const PageFolder& folder, const std::string& prefix, PagePicture reference,
                                     const ComparisonSettings& display);

  // Refuses what cannot be compared with the reference (metrics.h), in a sentence that names the picture.
  Status add(const PageFolder& folder, const PagePicture& picture);

  PageContent content;

 private:
  explicit PictureGroup(std::string prefix, Image reference);
  Status write_picture(const PageFolder& folder, const PageEntry& entry, const std::vector<Vec3>& radiance) const;
  Status write_map(const PageFolder& folder, const std::string& name, const std::vector<Vec3>& colours) const;

  std::string prefix_;
  Image reference_;
};

// What a file says about its render time: the first attribute with "render time" in its name, however that is written
// ("RenderTime", "renderTimeSeconds", "cycles.ViewLayer.render_time"), with " s" behind a bare number. Empty if none
// does.
std::string render_time_of(const std::map<std::string, std::string>& metadata);

}  // namespace luciole
