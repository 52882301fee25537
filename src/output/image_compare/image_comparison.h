// Two images beside each other: registered, and how far one is from the other.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "output/compare/error_measures.h"
#include "output/compare/free_scale.h"
#include "output/image_compare/pixel_image.h"
#include "output/image_compare/pixel_map.h"

namespace raytube {

/// Of one channel. Errors in decibels are those of tables, over pixels; a zero of the result counts as dynamic_range_db below the
/// reference's peak.
struct ImageMeasures {
  ErrorMeasures errors;
  double correlation = ErrorMeasures::undefined;      // Pearson's, of magnitudes
  double magnitude_error = ErrorMeasures::undefined;  // || |result| - |reference| || / ||reference||
  double power_ratio_db = ErrorMeasures::undefined;   // of the sums of sigma, result over reference
  double similarity = ErrorMeasures::undefined;       // of levels within within_db of the reference's peak
};

struct ImageComparison {
  PixelImage result, reference;
  double within_db;
  bool registered;
  dvec2 shift{0.0};  // of the result along columns and rows [pixels of the reference], taken back below
  PixelMap map{};
  std::optional<FreeScale> scale{};  // fitted, and in the pairs already

  std::array<bool, 4> compared{};      // both images have it
  std::array<bool, 4> signal{};        // as in Comparison
  std::array<bool, 4> unexpected{};    // as in Comparison
  std::array<ChannelPair, 4> pairs{};  // of the pixels of the map, row by row
  std::array<ImageMeasures, 4> measures{};

  std::size_t pixels() const { return map.pixels(); }
};

struct ImageComparisonOptions {
  double within_db = 20.0;
  bool free_scale = false;
  bool registered = true;  // else pixels are compared where they are
};

/// Throws InputError if the images share no channel or no pixel, or if one is zero throughout.
ImageComparison compare_images(PixelImage result, PixelImage reference, const ImageComparisonOptions& options = {});

/// ||result - reference|| / ||reference|| over all channels; infinite if one has channels of its own or no phase.
double relative_error(const ImageComparison& comparison);

}  // namespace raytube
