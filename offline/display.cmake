# SPDX-License-Identifier: Apache-2.0
# Live pixels in an image viewer.
find_package(Threads REQUIRED)
luciole_room(display
  SOURCES display/connection.cpp display/live_display.cpp display/viewer_packets.cpp
  LINK luciole_base luciole_image
  PRIVATE_LINK Threads::Threads)

luciole_test(display_test SOURCES display/display_test.cpp LINK luciole_display Threads::Threads)
