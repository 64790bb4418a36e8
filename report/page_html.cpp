// SPDX-License-Identifier: Apache-2.0
#include "report/page_html.h"

#include <fmt/format.h>

#include "report/html.h"

namespace luciole {

extern const char* const kPageStyle;   // page.css
extern const char* const kPageScript;  // page.js

// The script is at the end: without it, or with one that fails, the page above shows all pictures below each other.
std::string framed(const PageFrame& frame, const std::string& main) {
  std::string text = fmt::format(R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="{}">
<title>{}</title>
<link rel="icon" href="data:,">
<style>
{}</style>
</head>
<body{}>
<header>
{}</header>
<main>
)",
                                 frame.made_by, frame.title, kPageStyle, frame.body_attributes, frame.header);
  text += main + "</main>\n";
  if (frame.scripted) text += std::string("<script>\n") + kPageScript + "</script>\n";
  return text + "</body>\n</html>\n";
}

std::string page_html(const PageContent& content) {
  const std::string reference = escape_html(content.reference.name), made_by = escape_html(content.made_by);
  PageFrame frame;
  frame.title = "Comparison with " + reference;
  frame.made_by = made_by;
  frame.body_attributes = fmt::format(" data-exposure=\"{:.9g}\" data-tone-curve=\"{}\"", content.display.exposure,
                                      tone_curve_name(content.display.tone_curve));
  frame.header = fmt::format(R"(<h1>Comparison with <span class="name">{}</span></h1>
<p>{} {} of {} × {} pixels and a reference. Made by {}.</p>
)",
                             reference, content.pictures.size(), content.pictures.size() == 1 ? "picture" : "pictures",
                             content.width, content.height, made_by);
  const std::vector<PageContent> groups = {content};
  return framed(frame, figures_section(groups) + pictures_section(groups) + settings_section(content));
}

}  // namespace luciole
