// SPDX-License-Identifier: Apache-2.0
// The site of ./do reproduce: a page per figure, and an index of all.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "report/figure.h"

namespace luciole {

// Writes `folder`/NAME/index.html with the figure's pictures beside it; `folder` exists. What a comparison or map names
// must be there.
Status write_figure_page(const Figure& figure, const std::filesystem::path& folder, const std::string& made_by);

// Writes `folder`/index.html, which leads to the pages of these figures.
Status write_figure_index(const std::vector<Figure>& figures, const std::filesystem::path& folder,
                          const std::string& made_by);

}  // namespace luciole
