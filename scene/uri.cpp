// SPDX-License-Identifier: Apache-2.0
#include "scene/uri.h"

#include <algorithm>
#include <optional>

#include "scene/base64.h"
#include "scene/file_fault.h"

namespace luciole {
namespace {

int hexadecimal_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// A '%' that starts no valid escape stays as it is: exporters write file names such as "50% grey.png" unescaped.
std::string percent_decoded(const std::string& uri) {
  std::string text;
  text.reserve(uri.size());
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size()) {
      const int high = hexadecimal_digit(uri[i + 1]), low = hexadecimal_digit(uri[i + 2]);
      if (high >= 0 && low >= 0) {
        text += static_cast<char>(high * 16 + low);
        i += 2;
        continue;
      }
    }
    text += uri[i];
  }
  return text;
}

bool starts_with_scheme(const std::string& uri) {
  const std::size_t end = uri.find_first_of(":/?#");
  return end != std::string::npos && uri[end] == ':';
}

bool has_parent_segment(const std::string& path) {
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    if (path.compare(begin, end - begin, "..") == 0) return true;
    begin = end + 1;
  }
  return false;
}

}  // namespace

bool is_data_uri(const std::string& uri) { return uri.starts_with("data:"); }

Bytes decode_data_uri(const std::string& uri, const std::string& object) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos) fail("INVALID_URI", object, "its data URI has no comma");
  const std::string_view header = std::string_view(uri).substr(0, comma);
  if (!header.ends_with(";base64")) {
    const std::string text = percent_decoded(uri.substr(comma + 1));
    return {text.begin(), text.end()};
  }
  std::optional<Bytes> bytes = decode_base64(std::string_view(uri).substr(comma + 1));
  if (!bytes) fail("INVALID_URI", object, "its data URI is not valid base64");
  return std::move(*bytes);
}

bool stays_below_folder(const std::string& path) {
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  return !path.empty() && path.front() != '/' && path.find('\\') == std::string::npos && !has_parent_segment(path) &&
         std::none_of(path.begin(), path.end(), is_control);
}

std::string checked_relative_path(const std::string& uri, const std::string& object) {
  if (starts_with_scheme(uri)) fail("INVALID_URI", object, "\"" + printable(uri) + "\" is not a relative path");
  const std::string path = percent_decoded(uri);
  if (!stays_below_folder(path)) {
    fail("INVALID_URI", object, "\"" + printable(uri) + "\" does not name a file below the scene's folder");
  }
  return path;
}

Bytes resolve_uri(const std::string& uri, const std::string& object, const FileReader& files) {
  if (is_data_uri(uri)) return decode_data_uri(uri, object);
  const std::string path = checked_relative_path(uri, object);
  Result<Bytes> bytes = files(path);
  if (!bytes) throw FileFault(object + ": \"" + printable(path) + "\": " + bytes.error().message);
  return std::move(*bytes);
}

}  // namespace luciole
