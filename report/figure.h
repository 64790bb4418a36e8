// SPDX-License-Identifier: Apache-2.0
// A figure or table of a paper beside what was measured for it, as reproduce/figure.py writes it (figure.json).
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace luciole {

struct FigureCell {
  std::optional<double> ours, paper, ratio;  // ratio: ours over the paper's
  std::string reason;                        // why there is none of ours
};

struct FigureTable {
  std::string title, unit, note, row_title;
  std::vector<std::string> columns;
  bool has_paper = false;
  struct Row {
    std::string name;
    std::vector<FigureCell> cells;  // one per column
  };
  std::vector<Row> rows;
};

struct FigureClaim {
  std::string text, note, worst;  // worst: where the limit was missed most, or met least
  bool held = false, of_time = false;
  int kept = 0, of = 0;                     // of so many places the limit was kept at these
  double low = 0, high = 0;                 // of what was measured
  std::optional<double> at_least, at_most;  // the limit
  std::vector<double> paper;                // the paper's lowest and highest, or nothing
};

struct PlotCurve {
  std::string name;
  std::vector<std::pair<double, double>> points;  // both above 0
};

// On logarithmic scales.
struct FigurePlot {
  std::string title, x_title, y_title, note;
  std::vector<PlotCurve> series, laws;  // a law belongs to the series whose name begins its own
};

// Files are names in the folder of figure.json.
struct FigureComparison {
  std::string title;
  double exposure = 1;
  struct Picture {
    std::string name, file, time;
  };
  Picture reference;
  std::vector<Picture> pictures;
};

struct FigureMap {
  std::string title, file;  // an EXR with the layers lights_listed and lights_false
};

struct Figure {
  std::filesystem::path folder;
  std::string name, paper, paper_title, figure, title, says;
  bool quick = false;
  std::vector<std::string> stands_in, differs, missing, commands;
  std::vector<std::pair<std::string, std::string>> machine;  // what it is, its value
  std::vector<FigureTable> tables;
  std::vector<FigurePlot> plots;
  std::vector<FigureClaim> claims;
  std::vector<FigureComparison> comparisons;
  std::vector<FigureMap> maps;
};

// Refuses what is no such file, in a sentence that names the key that is missing or wrong.
Result<Figure> read_figure(const std::filesystem::path& path);

}  // namespace luciole
