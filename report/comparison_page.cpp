// SPDX-License-Identifier: Apache-2.0
#include "report/comparison_page.h"

#include <utility>

#include "image/output_file.h"

namespace luciole {

ComparisonPage::ComparisonPage(PageFolder folder, PictureGroup group)
    : folder_(std::move(folder)), group_(std::move(group)) {}

Result<ComparisonPage> ComparisonPage::create(const std::filesystem::path& folder, PagePicture reference,
                                              const ComparisonSettings& display, const std::string& made_by) {
  // What cannot be shown is refused before the folder is touched.
  if (Status status = check_comparable(reference.image); !status) {
    return Error{status.error().kind, reference.name + ": " + status.error().message};
  }
  Result<PageFolder> made = PageFolder::create(folder);
  if (!made) return made.error();
  Result<PictureGroup> group = PictureGroup::create(*made, "", std::move(reference), display);
  if (!group) return group.error();
  group->content.made_by = made_by;
  return ComparisonPage(std::move(*made), std::move(*group));
}

Status ComparisonPage::finish() {
  if (Status status = write_text(page_html(group_.content), folder_.file("index.html")); !status) return status;
  return folder_.commit();
}

}  // namespace luciole
