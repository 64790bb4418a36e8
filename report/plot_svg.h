// SPDX-License-Identifier: Apache-2.0
// A plot on logarithmic scales as SVG within a page, coloured by the page's style.
#pragma once
#include <string>
#include <vector>

#include "report/figure.h"

namespace luciole {

// Values where a logarithmic axis from `low` to `high` gets a mark: powers of ten, with 2 and 5 times these where the
// axis is short. 0 < low < high.
std::vector<double> log_ticks(double low, double high);

// A <figure> with the drawing and its legend. Empty where there is no point.
std::string plot_figure(const FigurePlot& plot);

}  // namespace luciole
