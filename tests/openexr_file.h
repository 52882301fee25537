// OpenEXR files as renderers write them.
#pragma once

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace raytube::testing {

struct OpenexrForm {
  Imf::Compression compression = Imf::NO_COMPRESSION;
  Imf::PixelType type = Imf::FLOAT;  // or HALF
  unsigned tile = 0;                 // its width; 0 for scan lines
  Imf::LevelMode levels = Imf::ONE_LEVEL;
};

class OpenexrWriter {
 public:
  /// Channels by name, from the top line on.
  OpenexrWriter(const Imath::Box2i& window, const std::map<std::string, std::vector<float>>& channels,
                const OpenexrForm& form = {})
      : header_(window, window) {
    header_.compression() = form.compression;
    if (form.tile > 0) header_.setTileDescription({form.tile, form.tile + 3, form.levels});
    for (const auto& [name, values] : channels) {
      header_.channels().insert(name, Imf::Channel(form.type));
      const std::vector<half>& halves = halves_[name] = {values.begin(), values.end()};
      pixels_.insert(name, form.type == Imf::HALF ? Imf::Slice::Make(Imf::HALF, halves.data(), window)
                                                  : Imf::Slice::Make(Imf::FLOAT, values.data(), window));
    }
  }

  void write(const std::filesystem::path& file) const { header_.hasTileDescription() ? write_tiles(file) : write_lines(file); }

 private:
  void write_lines(const std::filesystem::path& file) const {
    Imf::OutputFile out(file.c_str(), header_);
    out.setFrameBuffer(pixels_);
    out.writePixels(header_.dataWindow().max.y - header_.dataWindow().min.y + 1);
  }
  // Lower levels hold a corner of the image.
  void write_tiles(const std::filesystem::path& file) const {
    Imf::TiledOutputFile out(file.c_str(), header_);
    out.setFrameBuffer(pixels_);
    for (int level = 0; level < out.numXLevels(); ++level)
      out.writeTiles(0, out.numXTiles(level) - 1, 0, out.numYTiles(level) - 1, level);
  }

  Imf::Header header_;
  Imf::FrameBuffer pixels_;
  std::map<std::string, std::vector<half>> halves_;
};

}  // namespace raytube::testing
