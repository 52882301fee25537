#include "output/image_compare/read_image.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "output/image_compare/read_isar_netcdf.h"
#include "output/image_compare/read_openexr.h"
#include "output/image_compare/read_pixel_table.h"
#include "output/netcdf/netcdf_file.h"
#include "output/tables/result_table.h"

namespace raytube {

namespace {

bool is_openexr_name(const std::filesystem::path& file) { return lower_case(file.extension().string()) == ".exr"; }

bool is_image(const NamedFile& source) {
  if (is_openexr_name(source.file)) return true;
  if (is_radar_explorer_name(source.file)) return false;
  return is_netcdf_name(source.file) ? is_isar_netcdf(source.file) : is_pixel_table(source);
}

}  // namespace

bool are_images(const NamedFile& result, const NamedFile& reference) {
  const bool both[] = {is_image(result), is_image(reference)};
  if (both[0] != both[1])
    throw InputError(fmt::format("{} is an image and {} is none; compare two images, or two tables of looks",
                                 (both[0] ? result : reference).file.string(), (both[0] ? reference : result).file.string()));
  return both[0];
}

PixelImage read_image(const NamedFile& source) {
  if (is_openexr_name(source.file)) return read_openexr(source);
  if (!is_netcdf_name(source.file)) return read_pixel_table(source);
  if (!source.map.empty())
    throw InputError(fmt::format("{}: {} has variables, no columns; leave the option out", source.option, source.file.string()));
  return read_isar_netcdf(source.file);
}

}  // namespace raytube
