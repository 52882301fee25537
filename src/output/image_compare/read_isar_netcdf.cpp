#include "output/image_compare/read_isar_netcdf.h"

#include <cmath>

#include "core/error.h"
#include "output/netcdf/hdf5_in_use.h"
#include "output/netcdf/open_netcdf.h"

namespace raytube {

bool is_isar_netcdf(const std::filesystem::path& file) {
  const Hdf5InUse in_use;
  return OpenNetcdf(file).dimension("cross_range_m") > 0;
}

PixelImage read_isar_netcdf(const std::filesystem::path& file) {
  const Hdf5InUse in_use;
  const OpenNetcdf open(file);
  if (open.dimension("height_m") > 0)
    throw InputError(file.string() + ": is an image in space; compare images in a plane, of one angle and frequency");
  PixelImage image{file, true, {}, {}, {true, true, true, true}, {true, true, true, true}, {}};
  open.check_size(4.0 * sizeof(double) * static_cast<double>(open.dimension("range_m")) *
                  static_cast<double>(open.dimension("cross_range_m")));
  image.across = even_axis(open.numbers("cross_range_m", {"cross_range_m"}), file.string() + ": cross_range_m", "m");
  image.up = even_axis(open.numbers("range_m", {"range_m"}), file.string() + ": range_m", "m");
  const std::vector<double> real = open.numbers("S_re", {"range_m", "cross_range_m", "receive", "transmit"}),
                            imaginary = open.numbers("S_im", {"range_m", "cross_range_m", "receive", "transmit"});
  if (real.size() != 4 * image.pixels() || imaginary.size() != real.size()) open.refuse("S_re is not of four channels");
  for (std::size_t i = 0; i < real.size(); ++i) {
    if (!std::isfinite(real[i]) || !std::isfinite(imaginary[i])) open.refuse("holds a pixel that is not a finite number");
    image.s[i % 4].emplace_back(real[i], imaginary[i]);
  }
  return image;
}

}  // namespace raytube
