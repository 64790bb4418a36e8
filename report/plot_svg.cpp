// SPDX-License-Identifier: Apache-2.0
#include "report/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html.h"

namespace luciole {
namespace {

constexpr double kWidth = 720, kHeight = 440;                       // of the drawing [SVG units]
constexpr double kLeft = 74, kRight = 20, kTop = 14, kBottom = 58;  // margins for the scales
constexpr int kColours = 4;                                         // classes curve-0 .. of the page's style
constexpr double kShortAxis = 2.5;                                  // decades: below, 2 and 5 get marks, too

// One logarithmic axis: where a value lies on the page.
struct LogAxis {
  double low = 1, high = 10, begin = 0, end = 1;
  double place(double value) const { return begin + (end - begin) * std::log(value / low) / std::log(high / low); }
};

// A little wider than what is to be seen, so that no mark lies on the frame.
LogAxis axis_of(const FigurePlot& plot, bool vertical, double begin, double end) {
  double low = HUGE_VAL, high = 0;
  for (const std::vector<PlotCurve>* curves : {&plot.series, &plot.laws}) {
    for (const PlotCurve& curve : *curves) {
      for (const auto& [x, y] : curve.points)
        low = std::min(low, vertical ? y : x), high = std::max(high, vertical ? y : x);
    }
  }
  const double room = std::max(std::pow(high / low, 0.05), 1.12);
  return {low / room, high * room, begin, end};
}

std::string scales(const LogAxis& x, const LogAxis& y, const FigurePlot& plot) {
  std::string text;
  for (const double tick : log_ticks(x.low, x.high)) {
    text += fmt::format(
        "<path class=\"grid\" d=\"M{0:.1f} {1}V{2}\"/><text x=\"{0:.1f}\" y=\"{3}\" class=\"below\">{4}</text>\n",
        x.place(tick), kTop, kHeight - kBottom, kHeight - kBottom + 20, fmt::format("{:g}", tick));
  }
  for (const double tick : log_ticks(y.low, y.high)) {
    text += fmt::format(
        "<path class=\"grid\" d=\"M{0} {1:.1f}H{2}\"/><text x=\"{3}\" y=\"{1:.1f}\" class=\"beside\">{4}</text>\n",
        kLeft, y.place(tick), kWidth - kRight, kLeft - 8, fmt::format("{:g}", tick));
  }
  text += fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", kLeft, kTop,
                      kWidth - kLeft - kRight, kHeight - kTop - kBottom);
  text += fmt::format("<text class=\"below\" x=\"{}\" y=\"{}\">{}</text>\n", (kLeft + kWidth - kRight) / 2,
                      kHeight - 12, escape_html(plot.x_title));
  return text + fmt::format("<text class=\"upright\" transform=\"translate(16 {}) rotate(-90)\">{}</text>\n",
                            (kTop + kHeight - kBottom) / 2, escape_html(plot.y_title));
}

std::string path_of(const PlotCurve& curve, const LogAxis& x, const LogAxis& y) {
  std::string path;
  for (const auto& [a, b] : curve.points) {
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x.place(a), y.place(b));
  }
  return path;
}

std::string drawn(const PlotCurve& curve, int colour, const LogAxis& x, const LogAxis& y) {
  std::string text = fmt::format("<g class=\"curve-{}\"><path class=\"line\" d=\"{}\"/>", colour, path_of(curve, x, y));
  for (const auto& [a, b] : curve.points) {
    text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\"><title>{}: {:.6g}, {:.4g}</title></circle>",
                        x.place(a), y.place(b), escape_html(curve.name), a, b);
  }
  return text + "</g>\n";
}

int colour_of(const FigurePlot& plot, const std::string& law) {
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    if (law.starts_with(plot.series[i].name)) return static_cast<int>(i) % kColours;
  }
  return 0;
}

std::string legend_entry(const std::string& name, int colour, const char* kind) {
  return fmt::format(
      "<span><svg width=\"30\" height=\"10\" aria-hidden=\"true\" class=\"curve-{}\"><path class=\"{}\" "
      "d=\"M0 5H30\"/></svg>{}</span>\n",
      colour, kind, escape_html(name));
}

}  // namespace

std::vector<double> log_ticks(double low, double high) {
  const bool is_short = std::log10(high / low) < kShortAxis;
  std::vector<double> ticks;
  for (int decade = static_cast<int>(std::floor(std::log10(low))); std::pow(10, decade) <= high; ++decade) {
    for (const int digit : {1, 2, 5}) {
      const double tick = digit * std::pow(10, decade);
      if ((digit == 1 || is_short) && tick >= low && tick <= high) ticks.push_back(tick);
    }
  }
  return ticks;
}

std::string plot_figure(const FigurePlot& plot) {
  if (plot.series.empty()) return {};
  const LogAxis x = axis_of(plot, false, kLeft, kWidth - kRight), y = axis_of(plot, true, kHeight - kBottom, kTop);
  std::string text = fmt::format(
      "<figure class=\"plot\"><figcaption><h3>{0}</h3></figcaption>\n<svg viewBox=\"0 0 {1} {2}\" role=\"img\" "
      "aria-label=\"{0}: {3} over {4}, logarithmic scales\">\n",
      escape_html(plot.title), kWidth, kHeight, escape_html(plot.y_title), escape_html(plot.x_title));
  text += scales(x, y, plot);
  std::string legend;
  for (const PlotCurve& law : plot.laws) {
    const int colour = colour_of(plot, law.name);
    text += fmt::format("<path class=\"law curve-{}\" d=\"{}\"/>\n", colour, path_of(law, x, y));
    legend += legend_entry(law.name, colour, "law");
  }
  std::string measured;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const int colour = static_cast<int>(i) % kColours;
    text += drawn(plot.series[i], colour, x, y);
    measured += legend_entry(plot.series[i].name, colour, "line");
  }
  text += "</svg>\n<p class=\"legend\">" + measured + legend + "</p>\n";
  if (!plot.note.empty()) text += fmt::format("<p class=\"note\">{}</p>\n", escape_html(plot.note));
  return text + "</figure>\n";
}

}  // namespace luciole
