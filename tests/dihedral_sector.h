// A square right-angled dihedral over its whole sector, against its closed form.
#pragma once

#include "closed_forms.h"
#include "run.h"
#include "shapes.h"

namespace raytube::testing {

/// Largest |S - closed form| of both co-polar channels over 181 looks between the faces, relative to the largest |S|.
inline double dihedral_sector_error(double side, double frequency, const SolveOptions& o) {
  std::vector<Direction> looks;
  for (int i = 0; i <= 180; ++i) looks.push_back({90.0 * degree, 0.5 * i * degree});
  const SweepResult result = solve_soup(shapes::dihedral(side, side), monostatic(looks, frequency), o);
  double worst = 0.0, peak = 0.0;
  for (std::size_t i = 0; i < looks.size(); ++i)
    for (const int sign : {-1, 1}) {
      const Complex exact = closed_forms::dihedral(side, side, wavenumber(frequency), looks[i].phi, sign);
      worst = std::max(worst, std::abs((sign < 0 ? result.total[i].vv() : result.total[i].hh()) - exact));
      peak = std::max(peak, std::abs(exact));
    }
  return worst / peak;
}

}  // namespace raytube::testing
