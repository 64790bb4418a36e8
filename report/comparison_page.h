// SPDX-License-Identifier: Apache-2.0
// A page that compares anybody's pictures with a reference, picture after picture: only two are in memory.
#pragma once
#include <filesystem>
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

class ComparisonPage {
 public:
  // Nothing is to be seen in `folder` before finish(). `made_by`: program and version.
  static Result<ComparisonPage> create(const std::filesystem::path& folder, PagePicture reference,
                                       const ComparisonSettings& display, const std::string& made_by);

  // Refuses what cannot be compared with the reference (metrics.h), in a sentence that names the picture.
  Status add(const PagePicture& picture);

  // Writes index.html, and lets the folder appear.
  Status finish();

 private:
  ComparisonPage(PageFolder folder, Image reference);
  Status write_picture(const PageEntry& entry, const std::vector<Vec3>& radiance) const;
  Status write_map(const std::string& name, const std::vector<Vec3>& colours) const;

  PageFolder folder_;
  Image reference_;
  PageContent content_;
};

// What a file says about its render time: the first attribute with "render time" in its name, however that is written
// ("RenderTime", "renderTimeSeconds", "cycles.ViewLayer.render_time"), with " s" behind a bare number. Empty if none
// does.
std::string render_time_of(const std::map<std::string, std::string>& metadata);

}  // namespace luciole
