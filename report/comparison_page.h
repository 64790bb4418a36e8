// SPDX-License-Identifier: Apache-2.0
// A page that compares anybody's pictures with a reference, picture after picture.
#pragma once
#include <filesystem>
#include <string>

#include "report/picture_group.h"

namespace luciole {

class ComparisonPage {
 public:
  // Nothing is to be seen in `folder` before finish(). `made_by`: program and version.
  static Result<ComparisonPage> create(const std::filesystem::path& folder, PagePicture reference,
                                       const ComparisonSettings& display, const std::string& made_by);

  // Refuses what cannot be compared with the reference (metrics.h), in a sentence that names the picture.
  Status add(const PagePicture& picture) { return group_.add(folder_, picture); }

  // Writes index.html, and lets the folder appear.
  Status finish();

 private:
  ComparisonPage(PageFolder folder, PictureGroup group);

  PageFolder folder_;
  PictureGroup group_;
};

}  // namespace luciole
