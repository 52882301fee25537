#include "utd/sheet/sheet_table.h"

#include <algorithm>
#include <cmath>

#include "utd/wedge/rounding_guard.h"

namespace raytube {

bool is_sheet_rim(const Wedge& wedge, std::span<const Material> materials) {
  const auto& [front, back] = wedge.faces;
  return wedge.n >= 2.0 - rounding_guard && front.material != no_index && front.material == back.material &&
         front.patch == back.patch && materials[front.material].transmits();
}

SheetTable::SheetTable(std::span<const Material> materials, std::span<const double> frequencies)
    : frequencies_(frequencies.begin(), frequencies.end()) {
  for (const Material& material : materials) {
    std::vector<SheetPair>& pairs = pairs_.emplace_back(frequencies.size());
    for (std::size_t f = 0; f < frequencies.size() && material.transmits(); ++f)
      pairs[f] = sheet_pair(material, f, wavenumber(frequencies[f]));
  }
}

const SheetPair& SheetTable::at(std::uint32_t material, double frequency) const {
  const auto found = std::ranges::find(frequencies_, frequency);
  return pairs_[material][static_cast<std::size_t>(found - frequencies_.begin())];
}

// Rims whose sin(beta') are equal, as those of parallel ones, share their tables, one for each octave of the shortest strip.
const SheetHalfPlane& SheetHalfPlanes::at(const SheetPair& pair, bool electric, double sin_cone, double shortest) {
  const SheetAdmittance& sheet = electric ? pair.electric : pair.magnetic;
  const double rounded = std::round(sin_cone / tie_guard) * tie_guard;
  const int octave = std::clamp(std::ilogb(shortest), -1, 8);
  std::unique_ptr<SheetHalfPlane>& found = made_[{&sheet, rounded, octave}];
  if (!found) found = std::make_unique<SheetHalfPlane>(sheet, pair.slowest, rounded, std::ldexp(1.0, octave));
  return *found;
}

}  // namespace raytube
