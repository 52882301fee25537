// How alike the structure of two images is.
#pragma once

#include <cstddef>
#include <span>

namespace raytube {

/// The structural similarity index of Wang, Bovik, Sheikh & Simoncelli (IEEE Trans. Image Process. 13 (2004), eq. 13; K1 = 0.01,
/// K2 = 0.03, Gaussian window of 11 x 11 pixels and 1.5 wide) of two images row by row whose values run from 0 to `range`: its
/// mean over the pixels where one of them is above 0, as empty surroundings are alike in all images. At the borders the window
/// is what lies within. 1 where no pixel is above 0.
double structural_similarity(std::span<const double> a, std::span<const double> b, std::size_t columns, double range);

}  // namespace raytube
