// SPDX-License-Identifier: Apache-2.0
#include "report/figure.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace luciole {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> names(const Json& list) { return list.get<std::vector<std::string>>(); }

std::optional<double> number_or_none(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional<double>(value.get<double>());
}

template <class Item, class Read>
std::vector<Item> list_of(const Json& list, const Read& read) {
  if (!list.is_array()) throw std::runtime_error("a list is expected");
  std::vector<Item> items;
  for (const Json& entry : list) items.push_back(read(entry));
  return items;
}

FigureCell read_cell(const Json& cell) {
  return {number_or_none(cell.at("ours")), number_or_none(cell.at("paper")), number_or_none(cell.at("ratio")),
          cell.at("reason").get<std::string>()};
}

FigureTable read_table(const Json& table) {
  FigureTable read{table.at("title"),
                   table.at("unit"),
                   table.at("note"),
                   table.at("row_title"),
                   names(table.at("columns")),
                   table.at("has_paper"),
                   {}};
  read.rows = list_of<FigureTable::Row>(table.at("rows"), [&](const Json& row) {
    FigureTable::Row made{row.at("name"), list_of<FigureCell>(row.at("cells"), read_cell)};
    if (made.cells.size() != read.columns.size())
      throw std::runtime_error("a row of 'cells' is not as long as 'columns'");
    return made;
  });
  return read;
}

FigureClaim read_claim(const Json& claim) {
  FigureClaim read;
  read.text = claim.at("text"), read.note = claim.at("note"), read.worst = claim.at("worst");
  read.held = claim.at("held"), read.of_time = claim.at("of_time");
  read.kept = claim.at("kept"), read.of = claim.at("of");
  read.low = claim.at("low"), read.high = claim.at("high");
  read.at_least = number_or_none(claim.at("at_least")), read.at_most = number_or_none(claim.at("at_most"));
  read.paper = claim.at("paper").get<std::vector<double>>();
  return read;
}

PlotCurve read_curve(const Json& curve) {
  PlotCurve read{curve.at("name"), {}};
  for (const Json& point : curve.at("points")) {
    const double x = point.at(0), y = point.at(1);
    if (!(x > 0) || !(y > 0)) throw std::runtime_error("'points' lie on logarithmic scales and must be above 0");
    read.points.emplace_back(x, y);
  }
  return read;
}

FigurePlot read_plot(const Json& plot) {
  return {plot.at("title"),
          plot.at("x_title"),
          plot.at("y_title"),
          plot.at("note"),
          list_of<PlotCurve>(plot.at("series"), read_curve),
          list_of<PlotCurve>(plot.at("laws"), read_curve)};
}

FigureComparison read_comparison(const Json& group) {
  const Json& reference = group.at("reference");
  FigureComparison read{group.at("title"), group.at("exposure"), {reference.at("name"), reference.at("file"), ""}, {}};
  read.pictures = list_of<FigureComparison::Picture>(group.at("pictures"), [](const Json& picture) {
    return FigureComparison::Picture{picture.at("name"), picture.at("file"), picture.at("time")};
  });
  return read;
}

Figure read(const Json& text) {
  Figure figure;
  figure.name = text.at("name"), figure.paper = text.at("paper"), figure.paper_title = text.at("paper_title");
  figure.figure = text.at("figure"), figure.title = text.at("title"), figure.says = text.at("says");
  figure.quick = text.at("quick");
  figure.stands_in = names(text.at("stands_in")), figure.differs = names(text.at("differs"));
  figure.missing = names(text.at("missing")), figure.commands = names(text.at("commands"));
  for (const auto& [key, value] : text.at("machine").items()) {
    figure.machine.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  figure.tables = list_of<FigureTable>(text.at("tables"), read_table);
  figure.plots = list_of<FigurePlot>(text.at("plots"), read_plot);
  figure.claims = list_of<FigureClaim>(text.at("claims"), read_claim);
  figure.comparisons = list_of<FigureComparison>(text.at("comparisons"), read_comparison);
  figure.maps = list_of<FigureMap>(text.at("maps"), [](const Json& map) {
    return FigureMap{map.at("title"), map.at("file")};
  });
  return figure;
}

// It becomes the name of a folder.
bool plain_name(const std::string& name) {
  return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_") == std::string::npos;
}

}  // namespace

Result<Figure> read_figure(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) return Error{ErrorKind::failed, path.string() + ": cannot be read"};
  try {
    Figure figure = read(Json::parse(stream));
    if (!plain_name(figure.name)) throw std::runtime_error("'name' must be of small letters, digits, - and _");
    figure.folder = path.parent_path();
    return figure;
  } catch (const std::exception& failure) {
    return Error{ErrorKind::failed, path.string() + ": no figure of ./do reproduce: " + failure.what()};
  }
}

}  // namespace luciole
