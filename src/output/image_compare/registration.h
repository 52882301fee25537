// How far one image is shifted against another.
#pragma once

#include <cstddef>
#include <vector>

#include "core/field.h"

namespace raytube {

/// Magnitudes of a channel of both images at the same pixels, row by row.
struct MagnitudePair {
  std::vector<double> result, reference;
};

/// The shift d, along columns and rows, for which result(x + d) correlates best with reference(x), over all channels together
/// [pixels]: the highest whole number by fast transforms, up to half an image, then, of what both show there, the highest value
/// of the same sum of waves between pixels to a thousandth of one (Guizar-Sicairos, Thurman & Fienup, Opt. Lett. 33 (2008), p.
/// 156).
dvec2 best_shift(const std::vector<MagnitudePair>& channels, std::size_t columns, std::size_t rows);

}  // namespace raytube
