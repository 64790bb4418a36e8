// SPDX-License-Identifier: Apache-2.0
// Reflectance of clean metal surfaces at normal incidence, F0, as linear Rec. 709: the values in common use, which go
// back to measured optical constants. Alloys vary with their mixture: brass and bronze are typical ones.
#pragma once
#include "base/vector.h"

namespace luciole::workshop::metal {

inline const Vec3 kGold{1.000f, 0.782f, 0.344f};
inline const Vec3 kSilver{0.972f, 0.960f, 0.915f};
inline const Vec3 kCopper{0.955f, 0.638f, 0.538f};
inline const Vec3 kBrass{0.910f, 0.778f, 0.423f};
inline const Vec3 kBronze{0.840f, 0.610f, 0.400f};
inline const Vec3 kAluminium{0.913f, 0.922f, 0.924f};
inline const Vec3 kNickel{0.660f, 0.609f, 0.526f};
inline const Vec3 kPlatinum{0.673f, 0.637f, 0.585f};
inline const Vec3 kTitanium{0.542f, 0.497f, 0.449f};
inline const Vec3 kChromium{0.549f, 0.556f, 0.554f};
inline const Vec3 kSteel{0.562f, 0.565f, 0.578f};

}  // namespace luciole::workshop::metal
