// SPDX-License-Identifier: Apache-2.0
#include "report/page_html.h"

#include <fmt/format.h>

#include "report/html.h"

namespace luciole {

extern const char* const kPageStyle;   // page.css
extern const char* const kPageScript;  // page.js

// The script is at the end: without it, or with one that fails, the page above shows all pictures below each other.
std::string page_html(const PageContent& content) {
  const std::string reference = escape_html(content.reference.name), made_by = escape_html(content.made_by);
  std::string text = fmt::format(R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="{0}">
<title>Comparison with {1}</title>
<link rel="icon" href="data:,">
<style>
{2}</style>
</head>
<body data-exposure="{3:.9g}" data-tone-curve="{4}">
<header>
<h1>Comparison with <span class="name">{1}</span></h1>
<p>{5} {6} of {7} × {8} pixels and a reference. Made by {0}.</p>
</header>
<main>
)",
                                 made_by, reference, kPageStyle, content.display.exposure,
                                 tone_curve_name(content.display.tone_curve), content.pictures.size(),
                                 content.pictures.size() == 1 ? "picture" : "pictures", content.width, content.height);
  text += figures_section(content) + pictures_section(content) + settings_section(content);
  return text + "</main>\n<script>\n" + kPageScript + "</script>\n</body>\n</html>\n";
}

}  // namespace luciole
