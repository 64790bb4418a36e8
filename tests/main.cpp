// SPDX-License-Identifier: Apache-2.0
// Where every test program begins. GoogleTest's header, compiled before all others, is a third of what most of them
// take to compile: it is compiled once, here.
#include <gtest/gtest.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
