// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/render_time.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

namespace luciole {

namespace fs = std::filesystem;

std::string render_time_beside(const fs::path& picture) {
  constexpr std::uintmax_t kLargestStatistics = std::uintmax_t(16) << 20;  // [bytes], of thousands of frames
  const fs::path path = fs::path(picture).replace_extension(".json");
  std::error_code failure;
  if (!fs::is_regular_file(path, failure) || fs::file_size(path, failure) > kLargestStatistics) return {};
  std::ifstream stream(path, std::ios::binary);
  const nlohmann::json object = nlohmann::json::parse(stream, nullptr, false);
  if (!object.is_object() || !object.contains("settings") || !object.contains("processor")) return {};
  const auto number_of = [&](const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<double>() : 0.0;
  };
  const double frame_ms = number_of("frame_ms"), seconds = number_of("render_seconds");
  if (frame_ms > 0) return fmt::format("{:.4g} ms a frame", frame_ms);
  return seconds > 0 ? fmt::format("{:.4g} s", seconds) : std::string();
}

}  // namespace luciole
