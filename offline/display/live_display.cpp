// SPDX-License-Identifier: Apache-2.0
#include "offline/display/live_display.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "offline/display/connection.h"
#include "offline/display/viewer_packets.h"

namespace luciole {
namespace {

using namespace std::chrono_literals;

constexpr auto kPause = 500ms;                     // between two attempts to connect, and two looks at a quiet line
constexpr std::size_t kPacketPixels = 128 * 1024;  // 1.5 MB: an answer to Ctrl-C within one packet

}  // namespace

Result<ViewerAddress> parse_viewer_address(const std::string& text) {
  const Error malformed{ErrorKind::usage,
                        "--display must be HOST:PORT with a port from 1 to 65535, not '" + text + "'"};
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return malformed;
  std::string host = text.substr(0, colon);
  const std::string port = text.substr(colon + 1);
  const bool bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (bracketed) host = host.substr(1, host.size() - 2);
  const auto fits = [bracketed](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
           letter == '.' || letter == '-' || letter == '_' || (bracketed && (letter == ':' || letter == '%'));
  };
  if (host.empty() || host.size() > 253 || !std::all_of(host.begin(), host.end(), fits)) return malformed;
  unsigned number = 0;
  const auto [end, fault] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (fault != std::errc() || end != port.data() + port.size() || number < 1 || number > 65535) return malformed;
  return ViewerAddress{host, port};
}

// What the renderer's thread and the display's own share.
struct LiveDisplay::Shared {
  ViewerAddress address;
  std::string name;
  std::uint32_t width = 0, height = 0;

  mutable std::mutex mutex;
  std::condition_variable changed;
  std::optional<Image> next;  // to be sent
  bool connected = false, stopping = false, finished = false;

  // The thread: connects, shows what there is, and begins again when the line breaks.
  void run() {
    std::optional<Image> shown;  // for a viewer that comes back
    while (true) {
      if (std::optional<Connection> line = Connection::open(address.host, address.port)) serve(*line, shown);
      std::unique_lock lock(mutex);
      connected = false;
      changed.wait_for(lock, kPause, [this] { return stopping; });
      if (stopping) break;
    }
    const std::scoped_lock lock(mutex);
    finished = true;
    changed.notify_all();
  }

  // Until the line breaks or the end is asked for.
  void serve(Connection& line, std::optional<Image>& shown) {
    if (!line.send(create_image_packet(name, width, height))) return;
    if (shown && !send_picture(line, *shown)) return;
    while (true) {
      bool news = false;
      {
        std::unique_lock lock(mutex);
        connected = true;
        changed.wait_for(lock, kPause, [this] { return stopping || next; });
        news = next.has_value();
        if (!news && stopping) return;
        if (news) {
          shown = std::exchange(next, std::nullopt);
          connected = false;  // wants none while this one is sent
        }
      }
      if (!line.is_open()) return;
      if (news && !send_picture(line, *shown)) return;
    }
  }

  bool send_picture(Connection& line, const Image& picture) const {
    const auto rows = static_cast<std::uint32_t>(std::clamp<std::size_t>(kPacketPixels / width, 1, height));
    for (std::uint32_t row = 0; row < height; row += rows) {
      if (!line.send(update_image_packet(name, picture, row, std::min(rows, height - row)))) return false;
    }
    return true;
  }
};

LiveDisplay::LiveDisplay(const ViewerAddress& address, const std::string& name, std::uint32_t width,
                         std::uint32_t height)
    : shared_(std::make_shared<Shared>()) {
  shared_->address = address;
  shared_->name = name;
  shared_->width = width, shared_->height = height;
  std::thread([shared = shared_] { shared->run(); }).detach();
}

LiveDisplay::~LiveDisplay() {
  std::unique_lock lock(shared_->mutex);
  shared_->stopping = true;
  shared_->changed.notify_all();
  shared_->changed.wait_for(lock, 2s, [this] { return shared_->finished; });
}

bool LiveDisplay::wants_picture() const {
  const std::scoped_lock lock(shared_->mutex);
  return shared_->connected && !shared_->next;
}

void LiveDisplay::show(Image picture) {
  if (picture.width != shared_->width || picture.height != shared_->height || !picture.has_layer("")) return;
  const std::scoped_lock lock(shared_->mutex);
  shared_->next = std::move(picture);
  shared_->changed.notify_all();
}

}  // namespace luciole
