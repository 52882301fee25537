#include "output/report/centres_json.h"

#include <algorithm>

#include "output/report/blocks.h"
#include "output/report/packed.h"

namespace raytube {

namespace {

constexpr std::size_t most_centres = 1000;  // of a page: more only hide one another

}  // namespace

JsonValue centres_json(const StoredCentres& found, std::size_t look) {
  const std::size_t count = std::min(found.centres.size(), most_centres);
  std::vector<double> places, persistence;
  std::vector<std::string> mechanisms, parts;
  BlockLevels levels(Blocks(1, 1), Blocks(count, std::max<std::size_t>(count, 1)));
  for (std::size_t i = 0; i < count; ++i) {
    const StoredCentre& centre = found.centres[i];
    places.insert(places.end(), {centre.place.x, centre.place.y, centre.place.z});
    persistence.insert(persistence.end(),
                       {centre.persistence_ghz, centre.persistence_azimuth_deg, centre.persistence_elevation_deg});
    mechanisms.push_back(centre.mechanism);
    parts.push_back(centre.part);
    levels.add(0, i, centre.s);
  }
  return {{"look", look},
          {"ghz", found.frequency / 1e9},
          {"side", found.side},
          {"total", found.centres.size()},
          {"places", packed_floats(places)},
          {"persistence", packed_floats(persistence)},
          {"mechanism", mechanisms},
          {"part", parts},
          {"sigma", levels.json()}};
}

}  // namespace raytube
