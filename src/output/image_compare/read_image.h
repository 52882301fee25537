// Images from files of any kind.
#pragma once

#include "output/image_compare/pixel_image.h"

namespace raytube {

/// Whether files are images rather than tables of looks: OpenEXR, a netCDF file of raytube isar's, or a table with columns for
/// pixels. Throws InputError for one of either kind, and for a file that cannot be read.
bool are_images(const NamedFile& result, const NamedFile& reference);

/// Reads an image. Of a table with a header (see CsvReader) pixels are told apart by u_m, v_m or cross_range_m, range_m [m], or
/// by col, row or x, y; its channels are those of read_result_table, tx_pol with them, and it holds each pixel of a rectangle
/// once. Of OpenEXR channels are columns; its rows are counted from the lowest one. Throws InputError.
PixelImage read_image(const NamedFile& source);

}  // namespace raytube
