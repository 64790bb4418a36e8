// SPDX-License-Identifier: Apache-2.0
// The text of a page that compares pictures with a reference.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "image/metrics.h"

namespace luciole {

// A picture on the page. Its files are STEM.png (at the group's exposure) and STEM.js (linear_pixels.h); a picture that
// is not the reference also has STEM-error.png and STEM-flip.png.
struct PageEntry {
  std::string name;  // as the reader knows it
  std::string stem;
  std::map<std::string, std::string> metadata;
  std::string render_time;  // empty: not known
  Comparison figures;       // not of the reference
};

// A reference and what is held against it: all of a page of `luciole report --compare`, one of several groups of a
// figure's page.
struct PageContent {
  std::string title;                    // empty where it is the only one
  std::uint32_t width = 0, height = 0;  // of all pictures [pixels]
  ComparisonSettings display;
  std::string made_by;  // program and version
  PageEntry reference;
  std::vector<PageEntry> pictures;
};

// One HTML document with its style and script; all text is escaped.
std::string page_html(const PageContent& content);

// Everything round the text between <main> and </main>. `header` is HTML.
//   scripted  whether there are pictures to compare
struct PageFrame {
  std::string title, header, made_by, body_attributes;
  bool scripted = true;
};
std::string framed(const PageFrame& frame, const std::string& main);

// The document's sections (page_sections.cpp).
std::string figures_section(const std::vector<PageContent>& groups);   // RMSE, relMSE, FLIP, times
std::string pictures_section(const std::vector<PageContent>& groups);  // what is looked at, and the controls
std::string settings_section(const PageContent& content);              // metadata, those that differ first

}  // namespace luciole
