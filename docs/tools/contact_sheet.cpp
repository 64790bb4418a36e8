// SPDX-License-Identifier: Apache-2.0
// contact_sheet LIST PREFIX: small pictures with their names below, six in a row, as PREFIX_1.png, PREFIX_2.png, ...
// A line of LIST is "name<TAB>FILE.exr", or "name<TAB>a sentence" where there is no picture. Each picture is exposed so
// that its mean luminance becomes 0.18, as a sheet compares what scenes show and not how bright they are.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "docs/tools/bitmap_font.h"
#include "image/exr.h"
#include "image/png.h"
#include "image/tone_curve.h"

namespace luciole {
namespace {

constexpr int kColumns = 6, kRows = 5, kPictureWidth = 240, kPictureHeight = 160, kLabelHeight = 14;
constexpr int kLetterPitch = kGlyphWidth + 1, kLinePitch = kGlyphHeight + 3;
constexpr float kMiddleGrey = 0.18f;

struct Entry {
  std::string name, content;  // content: a file that ends in .exr, or a sentence
};

struct Sheet {
  int width = kColumns * kPictureWidth, height = 0;
  std::vector<Vec3> pixels;  // display-linear

  explicit Sheet(int rows)
      : height(rows * (kPictureHeight + kLabelHeight)),
        pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Vec3(0.02f, 0.02f, 0.02f)) {}

  void set(int x, int y, Vec3 colour) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = colour;
  }
};

void draw_text(Sheet& sheet, int left, int top, const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const Glyph dots = glyph(text[i]);
    for (int y = 0; y < kGlyphHeight; ++y) {
      for (int x = 0; x < kGlyphWidth; ++x) {
        if (!(dots[static_cast<std::size_t>(y)] >> (kGlyphWidth - 1 - x) & 1)) continue;
        sheet.set(left + static_cast<int>(i) * kLetterPitch + x, top + y, Vec3(0.8f, 0.8f, 0.8f));
      }
    }
  }
}

// A sentence in place of a picture.
void draw_sentence(Sheet& sheet, int left, int top, const std::string& sentence) {
  const std::size_t per_line = kPictureWidth / kLetterPitch - 2;
  int y = top + kLinePitch;
  for (std::size_t start = 0; start < sentence.size() && y < top + kPictureHeight - kLinePitch; y += kLinePitch) {
    draw_text(sheet, left + kLetterPitch, y, sentence.substr(start, per_line));
    start += per_line;
  }
}

float exposure_of(const std::vector<Vec3>& radiance) {
  double sum = 0;
  for (const Vec3& pixel : radiance) sum += luminance(pixel);
  const double mean = sum / static_cast<double>(radiance.size());
  return mean > 0 ? static_cast<float>(kMiddleGrey / mean) : 1.0f;
}

Status draw_picture(Sheet& sheet, int left, int top, const std::string& path) {
  const Result<Image> image = read_exr(path);
  if (!image) return image.error();
  const std::vector<Vec3> radiance = image->colours("");
  if (image->width != kPictureWidth || image->height != kPictureHeight || radiance.empty()) {
    return Error{ErrorKind::failed, path + ": is no colour picture of 240x160"};
  }
  const std::vector<Vec3> display = to_display(radiance, exposure_of(radiance), ToneCurve::pbr_neutral);
  for (int y = 0; y < kPictureHeight; ++y) {
    for (int x = 0; x < kPictureWidth; ++x) {
      sheet.set(left + x, top + y, display[static_cast<std::size_t>(y * kPictureWidth + x)]);
    }
  }
  return Done{};
}

// The last letters of a name tell most.
std::string fitted(const std::string& name) {
  const std::size_t letters = kPictureWidth / kLetterPitch - 1;
  return name.size() <= letters ? name : ".." + name.substr(name.size() - letters + 2);
}

Status write_sheet(const Entry* entries, int count, const std::string& path) {
  Sheet sheet((count + kColumns - 1) / kColumns);
  for (int i = 0; i < count; ++i) {
    const int left = i % kColumns * kPictureWidth, top = i / kColumns * (kPictureHeight + kLabelHeight);
    if (entries[i].content.ends_with(".exr")) {
      if (Status status = draw_picture(sheet, left, top, entries[i].content); !status) return status;
    } else {
      draw_sentence(sheet, left, top, entries[i].content);
    }
    draw_text(sheet, left + 3, top + kPictureHeight + 3, fitted(entries[i].name));
  }
  return write_png(sheet.pixels, static_cast<std::uint32_t>(sheet.width), static_cast<std::uint32_t>(sheet.height),
                   path);
}

Status write_sheets(const std::string& list, const std::string& prefix) {
  std::ifstream lines(list);
  if (!lines) return Error{ErrorKind::usage, list + ": cannot be read"};
  std::vector<Entry> entries;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t tab = line.find('\t');
    if (tab == std::string::npos) return Error{ErrorKind::usage, list + ": a line without a tab: " + line};
    entries.push_back({line.substr(0, tab), line.substr(tab + 1)});
  }
  const int total = static_cast<int>(entries.size()), per_sheet = kColumns * kRows;
  for (int first = 0; first < total; first += per_sheet) {
    const std::string path = prefix + "_" + std::to_string(first / per_sheet + 1) + ".png";
    if (Status status =
            write_sheet(&entries[static_cast<std::size_t>(first)], std::min(per_sheet, total - first), path);
        !status) {
      return status;
    }
    std::printf("%s\n", path.c_str());
  }
  return Done{};
}

}  // namespace
}  // namespace luciole

int main(int count, char** arguments) {
  if (count != 3) {
    std::fprintf(stderr, "contact_sheet LIST PREFIX\n");
    return 2;
  }
  const luciole::Status status = luciole::write_sheets(arguments[1], arguments[2]);
  if (!status) std::fprintf(stderr, "contact_sheet: %s\n", status.error().message.c_str());
  return status ? 0 : static_cast<int>(status.error().kind);
}
