// SPDX-License-Identifier: Apache-2.0
// Frames to a video file, through the program ffmpeg: raw pixels go down a pipe. The file appears whole or not at all.
#pragma once
#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"

namespace luciole {

struct VideoFormat {
  std::filesystem::path path;           // its ending says the container, to ffmpeg
  std::uint32_t width = 0, height = 0;  // [pixels], even: the colours of common videos have half the resolution
  double frames_per_second = 30;
};

// What can be refused before anything is rendered: odd sizes, a name without ending, a place that cannot be written to,
// a machine without ffmpeg on its PATH.
Status check_video(const VideoFormat& format);

class VideoWriter {
 public:
  // Starts ffmpeg, which writes beside the name. It is not disturbed by Ctrl-C, so that it can finish the file.
  static Result<VideoWriter> start(const VideoFormat& format);
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) = delete;
  ~VideoWriter();  // ends ffmpeg and removes what is not finished

  //   codes   sRGB, 8 bits, 3 * width * height, row 0 on top: what goes into a PNG
  Status add(const std::vector<std::uint8_t>& codes);
  // After the last frame: waits for ffmpeg and gives the file its name.
  Status finish();

 private:
  VideoWriter(VideoFormat format, std::filesystem::path partial);
  Status spawn();
  bool wait_for_end(double seconds);  // of ffmpeg; false: it still runs
  Error explain(const std::string& what);
  void discard();

  VideoFormat format_;
  std::filesystem::path partial_;
  pid_t child_ = 0;                  // 0: has been waited for
  int status_ = 0;                   // as waitpid says
  int pipe_ = -1;                    // to its standard input
  std::FILE* complaints_ = nullptr;  // its standard error
};

}  // namespace luciole
