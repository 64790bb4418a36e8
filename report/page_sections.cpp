// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.h"
#include "image/false_colour.h"
#include "report/html.h"
#include "report/page_html.h"

namespace luciole {
namespace {

constexpr std::size_t kLongestValue = 300;  // [bytes] of metadata shown; some programs store whole scenes

std::string number(double value) {
  if (!std::isfinite(value)) return "∞";
  return fmt::format("{:.4g}", value);
}

// A column of figures. Where less is better and pictures differ, the best is set in bold.
struct Column {
  const char* title;
  double (*value)(const Comparison&);
  bool less_is_better;
};

constexpr Column kColumns[] = {
    {"relMSE", [](const Comparison& c) { return c.relmse; }, true},
    {"RMSE", [](const Comparison& c) { return c.rmse; }, true},
    {"FLIP", [](const Comparison& c) { return c.flip; }, true},
    {"Largest difference", [](const Comparison& c) { return c.largest_difference; }, true},
    {"Mean ratio", [](const Comparison& c) { return c.mean_ratio; }, false},
};

bool any_time(const PageContent& content) {
  return std::any_of(content.pictures.begin(), content.pictures.end(),
                     [](const PageEntry& picture) { return !picture.render_time.empty(); });
}

std::string figures_row(const PageContent& content, const PageEntry& picture) {
  std::string row = fmt::format("<tr><th scope=\"row\">{}</th>", escape_html(picture.name));
  for (const Column& column : kColumns) {
    const auto others = [&](auto test) {
      return std::any_of(content.pictures.begin(), content.pictures.end(), [&](const PageEntry& other) {
        return test(column.value(picture.figures), column.value(other.figures));
      });
    };
    const bool best = column.less_is_better && !others(std::greater<double>()) && others(std::less<double>());
    const std::string text = number(column.value(picture.figures));
    row += best ? fmt::format("<td><strong>{}</strong></td>", text) : fmt::format("<td>{}</td>", text);
  }
  if (any_time(content)) {
    row += fmt::format("<td>{}</td>", picture.render_time.empty() ? "–" : escape_html(picture.render_time));
  }
  return row + "</tr>\n";
}

// The colours in between are mixed from sRGB codes here as there, so that nine stops are the whole map.
std::string scale_figure(const char* layer, const char* title, const std::vector<std::string>& ticks) {
  std::string stops;
  for (int i = 0; i <= 8; ++i) {
    const Vec3 colour = false_colour(static_cast<float>(i) / 8);
    const auto code = [](float linear) { return static_cast<int>(srgb_encode(linear) * 255 + 0.5f); };
    stops += fmt::format(", rgb({} {} {})", code(colour.x), code(colour.y), code(colour.z));
  }
  std::string marks;
  for (const std::string& tick : ticks) marks += fmt::format("<span>{}</span>", tick);
  return fmt::format(R"html(<figure class="scale" data-scale="{}"><figcaption>{}</figcaption>
<div class="bar" style="background: linear-gradient(to right{})"></div>
<div class="ticks">{}</div></figure>
)html",
                     layer, title, stops, marks);
}

std::string scales() {
  std::vector<std::string> decades;
  for (float tick = kLowestError; tick < kHighestError * 1.1f; tick *= 10) {
    decades.push_back(fmt::format("{:.3g}", tick));
  }
  return "<div class=\"scales\">\n" + scale_figure("error", "Relative error, logarithmic", decades) +
         scale_figure("flip", "FLIP, linear", {"0", "0.25", "0.5", "0.75", "1"}) + "</div>\n";
}

// One of the pictures that lie on top of each other in a stage; `pixels`: the stem of its radiance, if it has any.
std::string layer(const PageContent& content, const char* kind, const std::string& file, const std::string& pixels,
                  const std::string& label, const std::string& of_what = "") {
  return fmt::format(R"(<div class="layer" data-layer="{}"{}><img src="{}" width="{}" height="{}" alt="{}{}">
<p class="label">{}</p></div>
)",
                     kind, pixels.empty() ? "" : fmt::format(" data-pixels=\"{}\"", pixels), file, content.width,
                     content.height, label, of_what, label);
}

std::string panel(const PageContent& content, const PageEntry& picture) {
  const std::string name = escape_html(picture.name), reference = escape_html(content.reference.name);
  const std::string& stem = picture.stem;
  std::string text = fmt::format(
      R"(<figure class="panel">
<figcaption><h3>{0}</h3><p>relMSE {1}, FLIP {2}{3}</p></figcaption>
<div class="stage" style="--ratio: {4} / {5}" tabindex="0" role="group" aria-label="{0} and {6}" aria-describedby="keys">
)",
      name, number(picture.figures.relmse), number(picture.figures.flip),
      picture.render_time.empty() ? "" : ", " + escape_html(picture.render_time), content.width, content.height,
      reference);
  text += layer(content, "picture", stem + ".png", stem, name);
  text += layer(content, "reference", content.reference.stem + ".png", content.reference.stem, reference);
  text += layer(content, "error", stem + "-error.png", "", "Relative error", " of " + name);
  text += layer(content, "flip", stem + "-flip.png", "", "FLIP", " of " + name);
  text +=
      "<input class=\"split\" type=\"range\" min=\"0\" max=\"100\" step=\"any\" value=\"50\" "
      "aria-label=\"Border between left and right\">\n";
  return text + "</div>\n</figure>\n";
}

std::string choice(const char* id, const char* title, const char* chosen) {
  std::string options;
  for (const auto& [value, text] : {std::pair("picture", "Picture"), std::pair("reference", "Reference"),
                                    std::pair("error", "Relative error"), std::pair("flip", "FLIP")}) {
    options += fmt::format("<option value=\"{}\"{}>{}</option>", value,
                           std::string_view(value) == chosen ? " selected" : "", text);
  }
  return fmt::format("<label>{}<select id=\"{}\">{}</select></label>\n", title, id, options);
}

// Hidden until the script has the pixels: without it nothing would answer.
std::string controls() {
  return "<div class=\"controls\" hidden>\n<div class=\"choices\">\n" + choice("left", "Left", "picture") +
         choice("right", "Right", "reference") + R"(<fieldset><legend>View</legend>
<label><input type="radio" name="view" value="slider" checked>Slider</label>
<label><input type="radio" name="view" value="flip">Flip</label>
</fieldset>
<button type="button" id="flip">Flip now</button>
</div>
<div class="dials">
<label>Exposure<input id="exposure" type="range" min="-8" max="8" step="0.25" value="0">
<output for="exposure">0 EV</output></label>
<label>Zoom<input id="zoom" type="range" min="0" max="6" step="0.25" value="0"><output for="zoom">1×</output></label>
<button type="button" id="reset">Reset</button>
</div>
</div>
<p id="status" role="status"></p>
)";
}

constexpr const char* kKeys = R"(<details class="keys" hidden><summary>Keys and gestures</summary>
<p id="keys">In a picture: arrows move it, plus and minus zoom, 0 fits it, square brackets change the exposure, F flips,
1 to 4 choose what is left: picture, reference, error, FLIP; with Shift what is right.</p>
<p>Drag the handle to move the border. Drag a zoomed picture to move it; pinch, or turn the wheel with Ctrl, to zoom. All
pictures follow.</p></details>
)";

std::vector<const PageEntry*> all_entries(const PageContent& content) {
  std::vector<const PageEntry*> entries;
  for (const PageEntry& picture : content.pictures) entries.push_back(&picture);
  entries.push_back(&content.reference);
  return entries;
}

std::string value_of(const PageEntry& entry, const std::string& name) {
  const auto found = entry.metadata.find(name);
  return found == entry.metadata.end() ? "–" : escape_html(shortened(found->second, kLongestValue));
}

std::string differing_settings(const PageContent& content, const std::set<std::string>& names) {
  std::string text = R"(<div class="scroll" tabindex="0" role="region" aria-labelledby="settings">
<table class="settings"><thead><tr><th scope="col">Differing</th>)";
  for (const PageEntry* entry : all_entries(content)) {
    text += fmt::format("<th scope=\"col\">{}</th>", escape_html(entry->name));
  }
  text += "</tr></thead>\n<tbody>\n";
  for (const std::string& name : names) {
    text += fmt::format("<tr><th scope=\"row\">{}</th>", escape_html(name));
    for (const PageEntry* entry : all_entries(content)) text += fmt::format("<td>{}</td>", value_of(*entry, name));
    text += "</tr>\n";
  }
  return text + "</tbody></table>\n</div>\n";
}

std::string common_settings(const PageContent& content, const std::set<std::string>& names) {
  std::string text = fmt::format("<details><summary>{} that all have in common</summary>\n<dl>\n", names.size());
  for (const std::string& name : names) {
    text += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escape_html(name), value_of(content.reference, name));
  }
  return text + "</dl>\n</details>\n";
}

}  // namespace

namespace {

std::string figures_table(const PageContent& content, const std::string& label) {
  std::string text = fmt::format(R"(<div class="scroll" tabindex="0" role="region" aria-labelledby="{}">
<table class="figures"><thead><tr><th scope="col">Picture</th>)",
                                 label);
  for (const Column& column : kColumns) text += fmt::format("<th scope=\"col\">{}</th>", column.title);
  if (any_time(content)) text += "<th scope=\"col\">Time</th>";
  text += "</tr></thead>\n<tbody>\n";
  for (const PageEntry& picture : content.pictures) text += figures_row(content, picture);
  text += "</tbody></table>\n</div>\n";
  if (!content.reference.render_time.empty()) {
    text += fmt::format("<p class=\"note\">The reference took {}.</p>\n", escape_html(content.reference.render_time));
  }
  return text;
}

// Groups may differ in how bright they are shown.
std::string exposures(const std::vector<PageContent>& groups) {
  std::set<std::string> all;
  for (const PageContent& group : groups) all.insert(fmt::format("{:g}", group.display.exposure));
  return joined(all);
}

}  // namespace

std::string figures_section(const std::vector<PageContent>& groups) {
  std::string text = "<section>\n<h2 id=\"figures\">Figures</h2>\n";
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::string label = groups[i].title.empty() ? "figures" : fmt::format("figures-{}", i + 1);
    if (!groups[i].title.empty()) text += fmt::format("<h3 id=\"{}\">{}</h3>\n", label, escape_html(groups[i].title));
    text += figures_table(groups[i], label);
  }
  const ComparisonSettings& display = groups.front().display;
  return text +
         fmt::format(
             R"(<p class="note">For a picture x and the reference r, means over pixels and channels: RMSE is √mean((x − r)²), relMSE is
mean((x − r)² / (r² + 0.01 mean(r)²)), the mean ratio is mean(x) / mean(r). The relative error of a pixel is the square
root of its share of relMSE. FLIP is the mean of the difference that an
observer sees, from 0 to 1, at exposure {} with the tone curve {} and {:.0f} pixels per degree.</p>
</section>
)",
             exposures(groups), tone_curve_name(display.tone_curve), display.pixels_per_degree);
}

std::string pictures_section(const std::vector<PageContent>& groups) {
  std::string text = "<section>\n<h2>Pictures</h2>\n" + controls() + scales() + "<div class=\"panels\">\n";
  for (const PageContent& group : groups) {
    if (!group.title.empty()) text += fmt::format("<h3 class=\"group\">{}</h3>\n", escape_html(group.title));
    for (const PageEntry& picture : group.pictures) text += panel(group, picture);
  }
  return text + "</div>\n" + kKeys + "</section>\n";
}

std::string settings_section(const PageContent& content) {
  std::set<std::string> differing, common;
  for (const PageEntry* entry : all_entries(content)) {
    for (const auto& [name, value] : entry->metadata) {
      const auto has_it = [&name = name, &value = value](const PageEntry* other) {
        const auto found = other->metadata.find(name);
        return found != other->metadata.end() && found->second == value;
      };
      const std::vector<const PageEntry*> entries = all_entries(content);
      (std::all_of(entries.begin(), entries.end(), has_it) ? common : differing).insert(name);
    }
  }
  std::string text = "<section>\n<h2 id=\"settings\">Settings and versions</h2>\n";
  if (differing.empty() && common.empty()) text += "<p>The files tell nothing of how they were made.</p>\n";
  if (!differing.empty()) text += differing_settings(content, differing);
  if (!common.empty()) text += common_settings(content, common);
  return text + "</section>\n";
}

}  // namespace luciole
