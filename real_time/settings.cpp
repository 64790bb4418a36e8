// SPDX-License-Identifier: Apache-2.0
#include "real_time/settings.h"

#include "real_time/setting_names.h"

namespace luciole {

std::string to_string(BoundingVolume value) { return name_of(value); }
std::string to_string(TileTest value) { return name_of(value); }
std::string to_string(Culling value) { return name_of(value); }
std::string to_string(Ranges value) { return name_of(value); }
std::string to_string(Lobes value) { return name_of(value); }
std::string to_string(NearField value) { return name_of(value); }
std::string to_string(Filter value) { return name_of(value); }
std::string to_string(Engine value) { return name_of(value); }
std::string to_string(Front value) { return name_of(value); }

}  // namespace luciole
