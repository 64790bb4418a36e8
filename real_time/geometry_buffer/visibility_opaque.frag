// SPDX-License-Identifier: Apache-2.0
// A pixel shows a triangle.
#version 460
layout(location = 0) flat in uvec2 shown;
layout(location = 0) out uvec2 words;

void main() { words = shown; }
