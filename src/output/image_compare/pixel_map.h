// Which pixels of one image lie where those of another do, and what stands between them.
#pragma once

#include <vector>

#include "output/image_compare/pixel_image.h"

namespace raytube {

/// Along an axis: pixel i of `first` ... `first + count - 1` of the reference is at scale i + offset of the result.
struct AxisMap {
  std::size_t first, count;
  double scale, offset;

  double at(std::size_t i) const { return scale * static_cast<double>(first + i) + offset; }
};

struct PixelMap {
  AxisMap across, up;

  std::size_t pixels() const { return across.count * up.count; }
};

/// The pixels of the reference that lie within the result, by metres where both are placed. What lies at x in the reference is
/// taken from x + shift in the result [pixels of the reference]. Throws InputError for sizes that differ without metres, and
/// where nothing overlaps.
PixelMap map_pixels(const PixelImage& result, const PixelImage& reference, const dvec2& shift = dvec2(0.0));

/// A channel of the result at the pixels of the map: as it is at whole numbers, between them by cubic convolution (Keys, IEEE
/// Trans. ASSP 29 (1981), eq. 15), magnitudes by themselves, phases after the mean advance from pixel to pixel is taken off.
std::vector<Complex> sampled(const PixelImage& image, const std::vector<Complex>& values, const PixelMap& map);

/// A channel of the reference there.
std::vector<Complex> cropped(const PixelImage& image, const std::vector<Complex>& values, const PixelMap& map);

}  // namespace raytube
