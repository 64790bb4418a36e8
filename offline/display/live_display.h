// SPDX-License-Identifier: Apache-2.0
// Live pixels in an image viewer. Whatever happens to the viewer, rendering goes on.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "base/result.h"
#include "image/image.h"

namespace luciole {

struct ViewerAddress {
  std::string host, port;
};

// "localhost:14158", "[::1]:14158". Refused if host or port are malformed; whether anybody listens shows later.
Result<ViewerAddress> parse_viewer_address(const std::string& text);

class LiveDisplay {
 public:
  // Starts the thread that connects, and connects again as often as need be.
  //   name   the image's name in the viewer
  LiveDisplay(const ViewerAddress& address, const std::string& name, std::uint32_t width, std::uint32_t height);
  LiveDisplay(const LiveDisplay&) = delete;
  LiveDisplay& operator=(const LiveDisplay&) = delete;
  // Gives the last picture two seconds to arrive.
  ~LiveDisplay();

  // Whether a viewer is there and has got all that was shown.
  bool wants_picture() const;
  // Sent as soon as possible; one that was not sent yet is dropped.
  void show(Image picture);

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;  // the thread may outlive this object where a name takes long to resolve
};

}  // namespace luciole
