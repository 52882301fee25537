#include "output/image_compare/read_openexr.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "output/image_compare/openexr_planes.h"
#include "output/tables/table_columns.h"

namespace raytube {

namespace {

class PixelOfPlanes : public TableRow {
 public:
  PixelOfPlanes(const std::filesystem::path& file, const OpenexrPlanes& planes, std::size_t index)
      : file_(file), planes_(planes), index_(index) {}

  double finite_number(std::size_t column, const std::string& remedy) const override {
    const double value = planes_.values[column][index_];
    if (std::isfinite(value)) return value;
    throw InputError(fmt::format("{}, {}: is not a finite number; {}", location(), planes_.names[column], remedy));
  }
  bool is_minus_infinity(std::size_t column) const override {
    return planes_.values[column][index_] == -std::numeric_limits<float>::infinity();
  }
  std::string location() const override {
    return fmt::format("{}, column {} of line {}", file_.string(), index_ % planes_.columns, index_ / planes_.columns);
  }

 private:
  const std::filesystem::path& file_;
  const OpenexrPlanes& planes_;
  std::size_t index_;
};

}  // namespace

PixelImage read_openexr(const NamedFile& source) {
  const OpenexrPlanes planes = read_openexr_planes(source.file);
  const TableHeader header(source.file.string(), planes.names, source.map, source.option);
  const ChannelColumns columns = find_channels(header);
  if (columns.transmit) header.reject("tx_pol means nothing in an image of channels; leave it out of " + source.option);
  PixelImage image;
  image.file = source.file;
  image.across = {0.0, 1.0, planes.columns}, image.up = {0.0, 1.0, planes.rows};
  for (int c = 0; c < 4; ++c) {
    image.has_channel[c] = columns.channels[c].any(), image.has_phase[c] = columns.channels[c].has_phase();
    if (!image.has_channel[c]) continue;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      const std::size_t line = planes.rows - 1 - i / planes.columns;
      image.s[c].push_back(
          channel_value(PixelOfPlanes(source.file, planes, line * planes.columns + i % planes.columns), columns.channels[c]).s);
    }
  }
  return image;
}

}  // namespace raytube
