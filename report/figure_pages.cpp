// SPDX-License-Identifier: Apache-2.0
#include "report/figure_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "image/exr.h"
#include "image/output_file.h"
#include "image/png.h"
#include "image/tone_curve.h"
#include "report/figure_sections.h"
#include "report/html.h"
#include "report/light_map.h"
#include "report/picture_group.h"

namespace luciole {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kThumbnailWidth = 480;  // [pixels]

Result<PagePicture> read_picture(const Figure& figure, const FigureComparison::Picture& picture) {
  Result<Image> image = read_exr(figure.folder / picture.file);
  if (!image) return image.error();
  return PagePicture{picture.name, std::move(*image), picture.time};
}

Result<PictureGroup> write_group(const Figure& figure, const FigureComparison& comparison, const std::string& prefix,
                                 const PageFolder& folder) {
  ComparisonSettings display;
  display.exposure = static_cast<float>(comparison.exposure);
  Result<PagePicture> reference = read_picture(figure, comparison.reference);
  if (!reference) return reference.error();
  Result<PictureGroup> group = PictureGroup::create(folder, prefix, std::move(*reference), display);
  if (!group) return group.error();
  group->content.title = comparison.title;
  for (const FigureComparison::Picture& entry : comparison.pictures) {
    const Result<PagePicture> picture = read_picture(figure, entry);
    if (!picture) return picture.error();
    if (Status status = group->add(folder, *picture); !status) return status.error();
  }
  return group;
}

Status write_maps(const Figure& figure, const PageFolder& folder) {
  for (std::size_t i = 0; i < figure.maps.size(); ++i) {
    const fs::path file = figure.folder / figure.maps[i].file;
    const Result<Image> image = read_exr(file);
    if (!image) return image.error();
    const Result<std::vector<Vec3>> colours = light_map(*image);
    if (!colours) return Error{colours.error().kind, file.string() + ": " + colours.error().message};
    const std::string name = fmt::format("map-{}.png", i + 1);
    if (Status status = write_png(*colours, image->width, image->height, folder.file(name)); !status) return status;
  }
  return Done{};
}

// Means over whole blocks of pixels, at most kThumbnailWidth wide.
Status write_thumbnail(const Image& image, const std::vector<Vec3>& display_linear, const fs::path& path) {
  const std::uint32_t block = std::max(1u, (image.width + kThumbnailWidth - 1) / kThumbnailWidth);
  const std::uint32_t width = image.width / block, height = image.height / block;
  std::vector<Vec3> small(std::size_t(width) * height);
  for (std::uint32_t y = 0; y < height * block; ++y) {
    for (std::uint32_t x = 0; x < width * block; ++x) {
      Vec3& sum = small[std::size_t(y / block) * width + x / block];
      sum = sum + display_linear[std::size_t(y) * image.width + x] * (1.0f / static_cast<float>(block * block));
    }
  }
  return write_png(small, width, height, path);
}

// Of the first picture of ours, else of the first map.
Status write_own_thumbnail(const Figure& figure, const PageFolder& folder) {
  if (figure.comparisons.empty() && figure.maps.empty()) return Done{};
  const bool is_picture = !figure.comparisons.empty();
  const Result<Image> image = read_exr(
      figure.folder / (is_picture ? figure.comparisons.front().pictures.front().file : figure.maps.front().file));
  if (!image) return image.error();
  std::vector<Vec3> shown;
  if (is_picture) {
    const auto exposure = static_cast<float>(figure.comparisons.front().exposure);
    shown = to_display(image->colours(""), exposure, ToneCurve::pbr_neutral);
  } else {
    const Result<std::vector<Vec3>> colours = light_map(*image);
    if (!colours) return colours.error();
    shown = *colours;
  }
  return write_thumbnail(*image, shown, folder.file("thumbnail.png"));
}

bool has_thumbnail(const Figure& figure) { return !figure.comparisons.empty() || !figure.maps.empty(); }

std::string verdict_html(const Figure& figure) {
  std::string text;
  for (const bool of_time : {false, true}) {
    const std::string summary = claims_summary(figure, of_time);
    if (summary.empty()) continue;
    const bool all = std::all_of(figure.claims.begin(), figure.claims.end(),
                                 [&](const FigureClaim& claim) { return claim.of_time != of_time || claim.held; });
    text += fmt::format("<p class=\"{}\">{}: {}</p>\n", all ? "held" : "missed",
                        of_time ? "Claims of times" : "Claims of counts and errors", summary);
  }
  return text;
}

std::string card(const Figure& figure) {
  const std::string name = escape_html(figure.name), title = escape_html(figure.title);
  std::string text = fmt::format("<li class=\"card\"><a href=\"{}/index.html\">", name);
  if (has_thumbnail(figure)) text += fmt::format("<img src=\"{}/thumbnail.png\" alt=\"\">", name);
  if (!has_thumbnail(figure) && figure.plots.empty())
    text += "<span class=\"no-picture\" aria-hidden=\"true\">table</span>";
  if (!has_thumbnail(figure) && !figure.plots.empty())
    text += "<span class=\"no-picture\" aria-hidden=\"true\">plot</span>";
  text +=
      fmt::format("<strong>[{}] {}</strong> {}</a>\n", escape_html(figure.paper), escape_html(figure.figure), title);
  return text + (figure.quick ? "" : verdict_html(figure)) + "</li>\n";  // small sizes prove nothing
}

}  // namespace

Status write_figure_page(const Figure& figure, const fs::path& folder, const std::string& made_by) {
  Result<PageFolder> page = PageFolder::create(folder / figure.name);
  if (!page) return page.error();
  std::vector<PageContent> groups;
  for (std::size_t i = 0; i < figure.comparisons.size(); ++i) {
    const std::string prefix = figure.comparisons.size() > 1 ? fmt::format("group-{}-", i + 1) : "";
    const Result<PictureGroup> group = write_group(figure, figure.comparisons[i], prefix, *page);
    if (!group) return group.error();
    groups.push_back(group->content);
  }
  if (Status status = write_maps(figure, *page); !status) return status;
  if (Status status = write_own_thumbnail(figure, *page); !status) return status;
  PageFrame frame;
  frame.title = escape_html(fmt::format("[{}] {}", figure.paper, figure.figure));
  frame.made_by = escape_html(made_by);
  frame.header = figure_header(figure);
  frame.body_attributes = fmt::format(" class=\"figure-page\" data-tone-curve=\"{}\"", tone_curve_name({}));
  frame.scripted = !groups.empty();
  std::string text = claims_section(figure);
  if (!groups.empty()) text += pictures_section(groups);
  text += maps_section(figure) + plots_section(figure) + tables_section(figure);
  if (!groups.empty()) text += figures_section(groups);
  text += provenance_section(figure);
  if (Status status = write_text(framed(frame, text), page->file("index.html")); !status) return status;
  return page->commit();
}

Status write_figure_index(const std::vector<Figure>& figures, const fs::path& folder, const std::string& made_by) {
  PageFrame frame;
  frame.title = "The papers, remade";
  frame.made_by = escape_html(made_by);
  frame.scripted = false;
  frame.header = fmt::format(R"(<h1>The papers, remade</h1>
<p>Figures and tables of the papers on stochastic light culling, measured with this program: our pictures beside their
references, our numbers beside the published ones. Made by {} with <code>./do reproduce</code>.</p>
)",
                             escape_html(made_by));
  const auto is_quick = [](const Figure& figure) { return figure.quick; };
  if (std::any_of(figures.begin(), figures.end(), is_quick)) {
    frame.header +=
        "<p class=\"warning\">A quick run: small pictures, few lights. It shows that all works, and proves "
        "nothing.</p>\n";
  }
  std::string text, paper;
  for (const Figure& figure : figures) {
    if (figure.paper != paper) {
      if (!paper.empty()) text += "</ul>\n</section>\n";
      text += fmt::format("<section>\n<h2>[{}] {}</h2>\n<ul class=\"cards\">\n", escape_html(figure.paper),
                          escape_html(figure.paper_title));
      paper = figure.paper;
    }
    text += card(figure);
  }
  if (!paper.empty()) text += "</ul>\n</section>\n";
  return write_text(framed(frame, text), folder / "index.html");
}

}  // namespace luciole
