// Scattering centres as the page of a report takes them.
#pragma once

#include "core/json.h"
#include "output/products/read_centres_csv.h"

namespace raytube {

/// Of this look of the result.
JsonValue centres_json(const StoredCentres& found, std::size_t look);

}  // namespace raytube
