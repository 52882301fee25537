#include "output/image_compare/read_openexr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "imaging/isar.h"
#include "output/tables/table_columns.h"

namespace raytube {

namespace {

// All channels as numbers of single precision; whole numbers and halves become those.
struct Planes {
  std::vector<std::string> names;
  std::size_t columns = 0, rows = 0;
  std::vector<std::vector<float>> values;  // [channel][row from the top][column]
};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& problem) {
  throw InputError(fmt::format("{}: {}", file.string(), problem));
}

Planes read_planes(const std::filesystem::path& file) {
  Imf::InputFile in(file.c_str());
  const Imath::Box2i window = in.header().dataWindow();
  Planes planes;
  planes.columns = static_cast<std::size_t>(window.max.x - window.min.x + 1);
  planes.rows = static_cast<std::size_t>(window.max.y - window.min.y + 1);
  if (planes.columns * planes.rows > most_image_cells)
    refuse(file, fmt::format("has {} x {} pixels, more than {}; cut it", planes.columns, planes.rows, most_image_cells));
  for (auto channel = in.header().channels().begin(); channel != in.header().channels().end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) continue;  // chroma
    planes.names.emplace_back(channel.name());
    planes.values.emplace_back(planes.columns * planes.rows);
  }
  Imf::FrameBuffer frame;
  for (std::size_t i = 0; i < planes.names.size(); ++i)
    frame.insert(planes.names[i], Imf::Slice::Make(Imf::FLOAT, planes.values[i].data(), window));
  in.setFrameBuffer(frame);
  in.readPixels(window.min.y, window.max.y);
  return planes;
}

// The library's exceptions as sentences.
Planes planes_of(const std::filesystem::path& file) {
  try {
    return read_planes(file);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    refuse(file, fmt::format("cannot be read as OpenEXR ({}); give the path of a flat image", error.what()));
  }
}

class PixelOfPlanes : public TableRow {
 public:
  PixelOfPlanes(const std::filesystem::path& file, const Planes& planes, std::size_t index)
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
  const Planes& planes_;
  std::size_t index_;
};

}  // namespace

PixelImage read_openexr(const NamedFile& source) {
  const Planes planes = planes_of(source.file);
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
