// SPDX-License-Identifier: Apache-2.0
// Metal objects that people recognise. Each is centred on the origin and stands on y = 0, in metres.
#pragma once
#include <string>

#include "scene/recipes/mesh_builder.h"

namespace luciole::workshop::gallery {

// Turned on the lathe (turned_objects.cpp, chess_pieces.cpp).
Mesh finger_ring(Detail detail);  // a wedding band, 1.1 m wide
Mesh bowl(Detail detail);
Mesh amphora(Detail detail);
Mesh goblet(Detail detail);
Mesh bell(Detail detail);
Mesh mirror_dish(Detail detail);  // a concave mirror facing +y that focuses 1.6 m in front of it
Mesh candlestick(Detail detail);
Mesh kettle(Detail detail);
Mesh chess_king(Detail detail);
Mesh chess_queen(Detail detail);
Mesh chess_bishop(Detail detail);
Mesh chess_rook(Detail detail);
Mesh chess_pawn(Detail detail);

// Swept along curves (swept_objects.cpp).
Mesh torus_knot(Detail detail);
Mesh coil_spring(Detail detail);
Mesh trumpet(Detail detail);  // lying along x
Mesh armillary_sphere(Detail detail);
Mesh klein_bottle(Detail detail);

// Links along a hanging chain from a to b, `sag` below the straight line in the middle.
Mesh chain(Vec3 a, Vec3 b, float sag, Detail detail);

// Cut out of plate (cut_objects.cpp).
Mesh gear(std::uint32_t teeth, float radius, float thickness, Detail detail);
Mesh crown(Detail detail);
Mesh letters(const std::string& word, float height, Detail detail);  // along x, facing +z; C E I L O U only

// A round cloth of metal thread over a round table of this radius and height (cloth.cpp).
Mesh table_cloth(float table_radius, float table_height, Detail detail);

// A spiral staircase winding up round a post, to a landing at `height` that lies along -z if the whole is turned by -36
// degrees (staircase.cpp).
Mesh spiral_staircase(float height, Detail detail);

}  // namespace luciole::workshop::gallery
