// SPDX-License-Identifier: Apache-2.0
// LUCIOLE_THREAD_SANITIZER is defined where this code is compiled for the thread sanitizer. TBB and Embree are not, so
// that their hand-overs would look like races: there our loops run on plain threads, and Embree builds on one.
#pragma once

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define LUCIOLE_THREAD_SANITIZER
#endif
#endif
#if defined(__SANITIZE_THREAD__)
#define LUCIOLE_THREAD_SANITIZER
#endif
