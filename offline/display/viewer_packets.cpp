// SPDX-License-Identifier: Apache-2.0
#include "offline/display/viewer_packets.h"

#include <cstring>

namespace luciole {
namespace {

// Kinds of packets that are sent: [tev] IpcPacket::EType.
constexpr char kCreateImage = 4, kUpdateImageStrided = 6;
constexpr const char* kChannels[] = {"R", "G", "B"};

class Packet {
 public:
  explicit Packet(char kind) : bytes_(4, '\0') { bytes_ += kind; }

  void add_flag(bool flag) { bytes_ += flag ? '\1' : '\0'; }
  void add_text(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
  void add_number(std::uint32_t number) { add_bytes(number, 4); }
  void add_long(std::uint64_t number) { add_bytes(number, 8); }
  // x86-64 stores floats as the packets do.
  void add_floats(const float* values, std::size_t count) {
    bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(float));
  }

  std::string finish() {
    const std::size_t length = bytes_.size();
    for (std::size_t i = 0; i < 4; ++i) bytes_[i] = static_cast<char>(length >> (8 * i) & 0xff);
    return std::move(bytes_);
  }

 private:
  void add_bytes(std::uint64_t number, int count) {
    for (int i = 0; i < count; ++i) bytes_ += static_cast<char>(number >> (8 * i) & 0xff);
  }

  std::string bytes_;
};

}  // namespace

std::string create_image_packet(const std::string& name, std::uint32_t width, std::uint32_t height) {
  Packet packet(kCreateImage);
  packet.add_flag(true);  // shown at once
  packet.add_text(name);
  packet.add_number(width);
  packet.add_number(height);
  packet.add_number(3);
  for (const char* channel : kChannels) packet.add_text(channel);
  return packet.finish();
}

std::string update_image_packet(const std::string& name, const Image& picture, std::uint32_t first_row,
                                std::uint32_t rows) {
  const std::size_t pixels = std::size_t(rows) * picture.width, first = std::size_t(first_row) * picture.width;
  Packet packet(kUpdateImageStrided);
  packet.add_flag(false);  // the user may look at another image meanwhile
  packet.add_text(name);
  packet.add_number(3);
  for (const char* channel : kChannels) packet.add_text(channel);
  for (const std::uint32_t corner : {std::uint32_t(0), first_row, picture.width, rows}) packet.add_number(corner);
  for (std::uint64_t i = 0; i < 3; ++i) packet.add_long(i * pixels);  // where each channel begins [floats]
  for (int i = 0; i < 3; ++i) packet.add_long(1);                     // and the step from pixel to pixel
  for (const char* channel : kChannels) packet.add_floats(picture.channels.at(channel).data() + first, pixels);
  return packet.finish();
}

}  // namespace luciole
