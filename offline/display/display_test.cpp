// SPDX-License-Identifier: Apache-2.0
// The display against a viewer of our own, which decodes the packets as the real one does.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <optional>
#include <thread>

#include "offline/display/live_display.h"
#include "offline/display/viewer_packets.h"

namespace luciole {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// Reads fields off a packet; a read past the end fails the test.
class Fields {
 public:
  explicit Fields(std::string bytes) : bytes_(std::move(bytes)) {}

  template <class T>
  T number() {
    T value{};
    EXPECT_LE(at_ + sizeof(T), bytes_.size());
    if (at_ + sizeof(T) <= bytes_.size()) std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  std::string text() {
    const std::string found = bytes_.c_str() + at_;
    at_ += found.size() + 1;
    return found;
  }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  std::string bytes_;
  std::size_t at_ = 4;  // behind the length
};

// What the viewer shows.
struct Shown {
  std::string name;
  std::int32_t width = 0, height = 0;
  std::vector<float> channels[3];
  int created = 0, rows_updated = 0;

  void apply(const std::string& packet) {
    Fields fields(packet);
    const int kind = fields.number<char>();
    const bool focus = fields.number<char>() == 1;
    const std::string image = fields.text();
    if (kind == 4) {
      name = image;
      EXPECT_TRUE(focus);
      width = fields.number<std::int32_t>(), height = fields.number<std::int32_t>();
      EXPECT_EQ(fields.number<std::int32_t>(), 3);
      for (const char* channel : {"R", "G", "B"}) EXPECT_EQ(fields.text(), channel);
      for (auto& channel : channels) channel.assign(std::size_t(width) * std::size_t(height), 0);
      ++created, rows_updated = 0;
    } else {
      ASSERT_EQ(kind, 6);
      EXPECT_EQ(image, name);
      EXPECT_FALSE(focus);
      update(fields);
    }
    EXPECT_EQ(fields.left(), 0u);
  }

  void update(Fields& fields) {
    ASSERT_EQ(fields.number<std::int32_t>(), 3);
    for (const char* channel : {"R", "G", "B"}) EXPECT_EQ(fields.text(), channel);
    EXPECT_EQ(fields.number<std::int32_t>(), 0);
    const auto y = std::size_t(fields.number<std::int32_t>());
    EXPECT_EQ(fields.number<std::int32_t>(), width);
    const auto rows = std::size_t(fields.number<std::int32_t>());
    std::int64_t offsets[3], strides[3];
    for (auto& offset : offsets) offset = fields.number<std::int64_t>();
    for (auto& stride : strides) stride = fields.number<std::int64_t>();
    const std::size_t pixels = rows * std::size_t(width);
    ASSERT_LE((y + rows) * std::size_t(width), channels[0].size());
    std::vector<float> values(3 * pixels);
    for (float& value : values) value = fields.number<float>();
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < pixels; ++i) {
        channels[c][y * std::size_t(width) + i] = values[std::size_t(offsets[c]) + i * std::size_t(strides[c])];
      }
    }
    rows_updated += static_cast<int>(rows);
  }
};

class FakeViewer {
 public:
  explicit FakeViewer(std::uint16_t port = 0) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    const int yes = 1;
    setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    EXPECT_EQ(listen(socket_, 4), 0);
    socklen_t size = sizeof(address);
    getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  ~FakeViewer() {
    hang_up();
    close(socket_);
  }
  FakeViewer(const FakeViewer&) = delete;
  FakeViewer& operator=(const FakeViewer&) = delete;

  ViewerAddress address() const { return {"127.0.0.1", std::to_string(port_)}; }
  std::uint16_t port() const { return port_; }

  bool accept_one() {
    if (!readable(socket_)) return false;
    line_ = accept(socket_, nullptr, nullptr);
    return line_ >= 0;
  }
  void hang_up() {
    if (line_ >= 0) close(line_);
    line_ = -1;
  }

  // One whole packet; empty if none comes or the line was closed.
  std::string receive() {
    std::string packet(4, '\0');
    if (!fill(packet, 0)) return {};
    std::uint32_t length = 0;
    std::memcpy(&length, packet.data(), 4);
    packet.resize(length);
    return fill(packet, 4) ? packet : std::string();
  }

  // Applies packets until a whole picture is there.
  bool receive_picture(Shown& shown) {
    shown.rows_updated = 0;
    while (shown.created == 0 || shown.rows_updated < shown.height) {
      const std::string packet = receive();
      if (packet.empty()) return false;
      shown.apply(packet);
    }
    return true;
  }

 private:
  static bool readable(int socket) {
    pollfd wanted{socket, POLLIN, 0};
    return poll(&wanted, 1, 10000) == 1;
  }
  bool fill(std::string& bytes, std::size_t from) {
    while (from < bytes.size()) {
      const ssize_t count = readable(line_) ? recv(line_, bytes.data() + from, bytes.size() - from, 0) : 0;
      if (count <= 0) return false;
      from += static_cast<std::size_t>(count);
    }
    return true;
  }

  int socket_ = -1, line_ = -1;
  std::uint16_t port_ = 0;
};

Image picture_of(std::uint32_t width, std::uint32_t height, float base) {
  Image image;
  image.width = width, image.height = height;
  std::vector<Vec3> pixels(image.pixel_count());
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = Vec3(base + float(i), base - float(i), 0.5f * float(i));
  image.set_colours("", pixels);
  return image;
}

void expect_shows(const Shown& shown, const Image& picture) {
  EXPECT_EQ(shown.channels[0], picture.channels.at("R"));
  EXPECT_EQ(shown.channels[1], picture.channels.at("G"));
  EXPECT_EQ(shown.channels[2], picture.channels.at("B"));
}

bool becomes_wanted(const LiveDisplay& display) {
  for (const auto start = Clock::now(); Clock::now() - start < 10s; std::this_thread::sleep_for(1ms)) {
    if (display.wants_picture()) return true;
  }
  return false;
}

TEST(ViewerPackets, are_what_the_protocol_says) {
  const std::string expected("\x1d\0\0\0\4\1a b\0\x11\0\0\0\3\0\0\0\3\0\0\0R\0G\0B\0", 28);
  std::string right = expected;
  right[0] = static_cast<char>(right.size());
  EXPECT_EQ(create_image_packet("a b", 17, 3), right);
  const std::string update = update_image_packet("x", picture_of(4, 3, 0), 1, 2);
  // Length, kind, focus, name, count, names, rectangle, offsets, strides, pixels.
  EXPECT_EQ(update.size(), 4u + 1 + 1 + 2 + 4 + 6 + 16 + 24 + 24 + 3 * 8 * 4);
}

TEST(LiveDisplay, shows_every_pixel_also_in_several_packets) {
  for (const auto& [width, height] : {std::pair{1u, 1u}, std::pair{17u, 3u}, std::pair{700u, 401u}}) {
    FakeViewer viewer;
    LiveDisplay display(viewer.address(), "a picture", width, height);
    ASSERT_TRUE(viewer.accept_one());
    ASSERT_TRUE(becomes_wanted(display));
    Shown shown;
    for (const float base : {1.0f, 2.0f}) {
      const Image picture = picture_of(width, height, base);
      display.show(picture);
      ASSERT_TRUE(viewer.receive_picture(shown));
      expect_shows(shown, picture);
    }
    EXPECT_EQ(shown.name, "a picture");
    EXPECT_EQ(shown.created, 1);
  }
}

TEST(LiveDisplay, a_viewer_that_closes_and_comes_back_gets_the_picture_again) {
  std::optional<FakeViewer> viewer(std::in_place);
  const std::uint16_t port = viewer->port();
  LiveDisplay display(viewer->address(), "picture", 32, 8);
  ASSERT_TRUE(viewer->accept_one());
  ASSERT_TRUE(becomes_wanted(display));
  display.show(picture_of(32, 8, 1));
  Shown shown;
  ASSERT_TRUE(viewer->receive_picture(shown));
  viewer.reset();
  for (const auto start = Clock::now(); display.wants_picture() && Clock::now() - start < 10s;) {
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_FALSE(display.wants_picture());
  viewer.emplace(port);
  ASSERT_TRUE(viewer->accept_one());
  Shown again;
  ASSERT_TRUE(viewer->receive_picture(again));
  expect_shows(again, picture_of(32, 8, 1));
  ASSERT_TRUE(becomes_wanted(display));
  display.show(picture_of(32, 8, 2));
  ASSERT_TRUE(viewer->receive_picture(again));
  expect_shows(again, picture_of(32, 8, 2));
}

TEST(LiveDisplay, the_last_picture_arrives_before_the_end) {
  FakeViewer viewer;
  Shown shown;
  {
    LiveDisplay display(viewer.address(), "picture", 8, 8);
    ASSERT_TRUE(viewer.accept_one());
    ASSERT_TRUE(becomes_wanted(display));
    display.show(picture_of(8, 8, 5));
  }
  ASSERT_TRUE(viewer.receive_picture(shown));
  expect_shows(shown, picture_of(8, 8, 5));
}

TEST(LiveDisplay, nobody_listening_costs_nothing_and_is_no_error) {
  std::uint16_t port = 0;
  { port = FakeViewer().port(); }  // closed again
  const auto start = Clock::now();
  {
    LiveDisplay display({"127.0.0.1", std::to_string(port)}, "picture", 8, 8);
    std::this_thread::sleep_for(50ms);
    EXPECT_FALSE(display.wants_picture());
    display.show(picture_of(8, 8, 1));
  }
  EXPECT_LT(Clock::now() - start, 2s);
}

TEST(LiveDisplay, a_viewer_that_stops_reading_delays_nobody) {
  FakeViewer viewer;
  const auto start = Clock::now();
  {
    LiveDisplay display(viewer.address(), "picture", 2048, 2048);  // 50 MB: more than the line buffers
    ASSERT_TRUE(viewer.accept_one());
    ASSERT_TRUE(becomes_wanted(display));
    Image picture = picture_of(2048, 2048, 1), other = picture;
    const auto before = Clock::now();
    display.show(std::move(picture));
    std::this_thread::sleep_for(100ms);
    display.show(std::move(other));
    EXPECT_FALSE(display.wants_picture());
    EXPECT_LT(Clock::now() - before, 1s);
  }
  EXPECT_LT(Clock::now() - start, 8s);
}

TEST(ViewerAddress, malformed_ones_are_refused) {
  for (const char* text : {"", ":", "localhost", "localhost:", ":14158", "localhost:0", "localhost:65536",
                           "localhost:14158x", "local host:14158", "a/b:14158", "::1:14158", "host:-1", "host: 1"}) {
    const Result<ViewerAddress> address = parse_viewer_address(text);
    ASSERT_FALSE(address.has_value()) << text;
    EXPECT_EQ(address.error().kind, ErrorKind::usage);
  }
  EXPECT_EQ(parse_viewer_address("localhost:14158")->host, "localhost");
  EXPECT_EQ(parse_viewer_address("[::1]:14158")->host, "::1");
  EXPECT_EQ(parse_viewer_address("10.0.0.7:1")->port, "1");
}

}  // namespace
}  // namespace luciole
