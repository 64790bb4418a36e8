// SPDX-License-Identifier: Apache-2.0
#include "report/figure_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html.h"
#include "report/light_map.h"
#include "report/plot_svg.h"

namespace luciole {
namespace {

std::string bullet_list(const std::vector<std::string>& items) {
  std::string text = "<ul>";
  for (const std::string& item : items) text += fmt::format("<li>{}</li>\n", escape_html(item));
  return text + "</ul>\n";
}

std::string cell_html(const FigureCell& cell, bool has_paper) {
  if (!cell.ours && !cell.paper) {
    return fmt::format("<td><abbr title=\"{0}\" aria-label=\"none: {0}\">–</abbr></td>", escape_html(cell.reason));
  }
  std::string text = cell.ours ? fmt::format("<td><b>{}</b>", figure_number(*cell.ours)) : "<td><b>–</b>";
  if (has_paper) {
    text += cell.paper ? fmt::format(" <span class=\"paper\">{}</span>", figure_number(*cell.paper))
                       : " <span class=\"paper\">–</span>";
    if (cell.ratio) text += fmt::format(" <span class=\"ratio\">×{}</span>", figure_number(*cell.ratio));
  }
  return text + "</td>";
}

// Why some cells are empty, each reason once.
std::string reasons(const FigureTable& table) {
  std::string text;
  std::vector<std::string> told;
  for (const FigureTable::Row& row : table.rows) {
    for (const FigureCell& cell : row.cells) {
      if (cell.reason.empty() || std::find(told.begin(), told.end(), cell.reason) != told.end()) continue;
      told.push_back(cell.reason);
      text += fmt::format("<p class=\"note\">{}: {}.</p>\n", escape_html(row.name), escape_html(cell.reason));
    }
  }
  return text;
}

std::string table_html(const FigureTable& table, std::size_t number) {
  const std::string unit = table.unit.empty() ? "" : " [" + table.unit + "]";
  std::string text = fmt::format(R"(<h3 id="table-{0}">{1}{2}</h3>
<div class="scroll" tabindex="0" role="region" aria-labelledby="table-{0}">
<table class="figures published"><thead><tr><th scope="col">{3}</th>)",
                                 number, escape_html(table.title), escape_html(unit), escape_html(table.row_title));
  for (const std::string& column : table.columns) text += fmt::format("<th scope=\"col\">{}</th>", escape_html(column));
  text += "</tr></thead>\n<tbody>\n";
  for (const FigureTable::Row& row : table.rows) {
    text += fmt::format("<tr><th scope=\"row\">{}</th>", escape_html(row.name));
    for (const FigureCell& cell : row.cells) text += cell_html(cell, table.has_paper);
    text += "</tr>\n";
  }
  text += "</tbody></table>\n</div>\n";
  if (!table.note.empty()) text += fmt::format("<p class=\"note\">{}</p>\n", escape_html(table.note));
  return text + reasons(table);
}

std::string range_text(double low, double high) {
  const std::string from = figure_number(low), to = figure_number(high);
  return from == to ? from : from + " to " + to;
}

std::string limit_text(const FigureClaim& claim) {
  std::string text;
  if (claim.at_least) text = "at least " + figure_number(*claim.at_least);
  if (claim.at_most) text += (text.empty() ? "at most " : " and at most ") + figure_number(*claim.at_most);
  return text;
}

std::string claim_row(const FigureClaim& claim) {
  std::string verdict = claim.held ? "<td class=\"held\">held</td>" : "<td class=\"missed\">not held";
  if (!claim.held) {
    if (claim.of > 1) verdict += fmt::format(" ({} of {})", claim.kept, claim.of);
    if (!claim.worst.empty()) verdict += fmt::format("<br><small>worst: {}</small>", escape_html(claim.worst));
    verdict += "</td>";
  }
  const std::string note = claim.note.empty() ? "" : fmt::format("<br><small>{}</small>", escape_html(claim.note));
  return fmt::format("<tr><th scope=\"row\">{}{}</th><td>{}</td><td><b>{}</b></td><td>{}</td>{}</tr>\n",
                     escape_html(claim.text), note, limit_text(claim), range_text(claim.low, claim.high),
                     claim.paper.empty() ? "–" : range_text(claim.paper.front(), claim.paper.back()), verdict);
}

std::string claims_table(const Figure& figure, bool of_time, const char* title, const char* id) {
  if (claims_summary(figure, of_time).empty()) return {};
  std::string text = fmt::format(R"(<div class="scroll" tabindex="0" role="region" aria-labelledby="{0}">
<table class="claims"><thead><tr><th scope="col" id="{0}">{1}</th><th scope="col">Limit</th><th scope="col">Ours</th>
<th scope="col">The paper's</th><th scope="col">Verdict</th></tr></thead>
<tbody>
)",
                                 id, title);
  for (const FigureClaim& claim : figure.claims) {
    if (claim.of_time == of_time) text += claim_row(claim);
  }
  return text + "</tbody></table>\n</div>\n";
}

std::string word_of(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

}  // namespace

std::string figure_number(double value) {
  if (!std::isfinite(value)) return "∞";
  const double size = std::abs(value);
  if (value == 0 || (size >= 0.01 && size < 1e5)) {
    return fmt::format("{:.{}f}", value, size >= 1000 ? 0 : size >= 100 ? 1 : size >= 1 || value == 0 ? 2 : 3);
  }
  return fmt::format("{:.2e}", value);
}

std::string figure_header(const Figure& figure) {
  std::string text = fmt::format(R"(<p><a href="../index.html">All figures</a></p>
<h1>[{}] {}: {}</h1>
<p>{}.</p>
<p class="says">The paper: {}</p>
)",
                                 escape_html(figure.paper), escape_html(figure.figure), escape_html(figure.title),
                                 escape_html(figure.paper_title), escape_html(figure.says));
  if (figure.quick)
    text +=
        "<p class=\"warning\">A quick run: small pictures, few lights. It shows that all works, and proves "
        "nothing.</p>\n";
  for (const std::string& reason : figure.missing) {
    text += fmt::format("<p class=\"warning\">Left out: {}.</p>\n", escape_html(reason));
  }
  if (!figure.stands_in.empty()) text += "<h2>What stands in</h2>\n" + bullet_list(figure.stands_in);
  if (!figure.differs.empty()) text += "<h2>What differs</h2>\n" + bullet_list(figure.differs);
  return text;
}

std::string claims_summary(const Figure& figure, bool of_time) {
  int held = 0, all = 0;
  for (const FigureClaim& claim : figure.claims) {
    if (claim.of_time == of_time) ++all, held += claim.held;
  }
  return all == 0 ? "" : fmt::format("{} of {} held", held, all);
}

std::string claims_section(const Figure& figure) {
  if (figure.claims.empty()) return {};
  return "<section>\n<h2>Claims</h2>\n" + claims_table(figure, false, "Of counts and errors", "claims-counts") +
         claims_table(figure, true, "Of times", "claims-times") + "</section>\n";
}

std::string tables_section(const Figure& figure) {
  if (figure.tables.empty()) return {};
  std::string text = "<section>\n<h2>Tables</h2>\n";
  const auto has_paper = [](const FigureTable& table) { return table.has_paper; };
  if (std::any_of(figure.tables.begin(), figure.tables.end(), has_paper)) {
    text +=
        "<p class=\"note\"><b>Ours</b> <span class=\"paper\">the paper's</span> <span class=\"ratio\">×ours over the "
        "paper's</span>; – where there is none.</p>\n";
  }
  for (std::size_t i = 0; i < figure.tables.size(); ++i) text += table_html(figure.tables[i], i + 1);
  return text + "</section>\n";
}

std::string plots_section(const Figure& figure) {
  std::string text;
  for (const FigurePlot& plot : figure.plots) text += plot_figure(plot);
  return text.empty() ? text : "<section>\n<h2>Plots</h2>\n<div class=\"plots\">\n" + text + "</div>\n</section>\n";
}

std::string maps_section(const Figure& figure) {
  if (figure.maps.empty()) return {};
  std::string text = fmt::format(R"(<section>
<h2>Lights per pixel</h2>
<figure class="scale"><figcaption>Brightness: lights listed, white light at {:.0f}. Hue: how many of them in vain</figcaption>
<div class="bar hues"></div><div class="ticks"><span>0 %</span><span>25 %</span><span>50 %</span><span>75 %</span><span>100 %</span></div></figure>
<div class="panels maps">
)",
                                 kBrightestLightCount);
  for (std::size_t i = 0; i < figure.maps.size(); ++i) {
    text += fmt::format(
        "<figure class=\"panel\"><img src=\"map-{0}.png\" alt=\"Lights per pixel: {1}\">"
        "<figcaption>{1}</figcaption></figure>\n",
        i + 1, escape_html(figure.maps[i].title));
  }
  return text + "</div>\n</section>\n";
}

std::string provenance_section(const Figure& figure) {
  std::string text = "<section>\n<h2>How it was made</h2>\n<dl class=\"machine\">\n";
  for (const auto& [key, value] : figure.machine) {
    text += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escape_html(word_of(key)), escape_html(value));
  }
  text += fmt::format("</dl>\n<p>All of it: <code>./do reproduce {}{}</code></p>\n", escape_html(figure.name),
                      figure.quick ? " --quick" : "");
  std::string commands;
  for (const std::string& command : figure.commands) commands += escape_html(command) + "\n";
  return text +
         fmt::format("<details><summary>Commands: {}</summary>\n<pre tabindex=\"0\">{}</pre>\n</details>\n</section>\n",
                     figure.commands.size(), commands);
}

}  // namespace luciole
