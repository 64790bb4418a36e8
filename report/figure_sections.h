// SPDX-License-Identifier: Apache-2.0
// What a figure's page says beside its pictures. All text is escaped.
#pragma once
#include <string>

#include "report/figure.h"

namespace luciole {

// At most four digits; what is very large or small with an exponent.
std::string figure_number(double value);

std::string figure_header(const Figure& figure);       // the paper's claim, what stands in, what is missing
std::string claims_section(const Figure& figure);      // held or not; empty without claims
std::string tables_section(const Figure& figure);      // ours, the paper's, the ratio; empty without tables
std::string plots_section(const Figure& figure);       // empty without plots
std::string maps_section(const Figure& figure);        // lights per pixel, map-N.png; empty without maps
std::string provenance_section(const Figure& figure);  // commands and machine

// "5 of 6 claims held", of those of counts and errors or of those of times; empty where there is none.
std::string claims_summary(const Figure& figure, bool of_time);

}  // namespace luciole
