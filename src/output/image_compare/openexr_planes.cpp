#include "output/image_compare/openexr_planes.h"

#include <OpenEXR/openexr.h>
#include <fmt/format.h>

#include <cstdint>

#include "core/error.h"
#include "imaging/isar.h"

namespace raytube {

namespace {

constexpr int first_part = 0, full_resolution = 0;

[[noreturn]] void refuse_openexr(const std::filesystem::path& file, const std::string& problem) {
  throw InputError(fmt::format("{}: cannot be read as OpenEXR ({}); give the path of a flat image", file.string(), problem));
}

// The library would print what is wrong.
void say_nothing(exr_const_context_t, exr_result_t, const char*) {}

bool fills_all_pixels(int x_sampling, int y_sampling) { return x_sampling == 1 && y_sampling == 1; }

// What is read of a chunk, a few lines or a tile.
class ChunkDecoder {
 public:
  ChunkDecoder(exr_const_context_t context, const exr_chunk_info_t& chunk)
      : context_(context), result_(exr_decoding_initialize(context, first_part, &chunk, &steps_)) {}
  ~ChunkDecoder() { exr_decoding_destroy(context_, &steps_); }
  ChunkDecoder(const ChunkDecoder&) = delete;
  ChunkDecoder& operator=(const ChunkDecoder&) = delete;

  exr_result_t decode(OpenexrPlanes& planes, std::size_t first_pixel) {
    if (result_ != EXR_ERR_SUCCESS) return result_;
    aim(planes, first_pixel);
    result_ = exr_decoding_choose_default_routines(context_, first_part, &steps_);
    return result_ == EXR_ERR_SUCCESS ? exr_decoding_run(context_, first_part, &steps_) : result_;
  }

 private:
  // Channels without a place to go to are skipped.
  void aim(OpenexrPlanes& planes, std::size_t first_pixel) {
    auto plane = planes.values.begin();
    for (int c = 0; c < steps_.channel_count; ++c) {
      exr_coding_channel_info_t& channel = steps_.channels[c];
      if (!fills_all_pixels(channel.x_samples, channel.y_samples)) continue;
      channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(plane++->data() + first_pixel);
      channel.user_data_type = EXR_PIXEL_FLOAT, channel.user_bytes_per_element = sizeof(float);
      channel.user_pixel_stride = sizeof(float);
      channel.user_line_stride = static_cast<std::int32_t>(sizeof(float) * planes.columns);
    }
  }

  exr_const_context_t context_;
  exr_decode_pipeline_t steps_{};
  exr_result_t result_;
};

class OpenexrFile {
 public:
  explicit OpenexrFile(const std::filesystem::path& file) : file_(file) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = say_nothing;
    how.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    expect(exr_start_read(&context_, file.c_str(), &how));
  }
  ~OpenexrFile() { exr_finish(&context_); }
  OpenexrFile(const OpenexrFile&) = delete;
  OpenexrFile& operator=(const OpenexrFile&) = delete;

  OpenexrPlanes planes() {
    int parts = 0;
    expect(exr_get_count(context_, &parts));
    if (parts > 1) refuse_openexr(file_, fmt::format("it has {} parts; save one of them by itself", parts));
    check_compression();
    OpenexrPlanes planes = empty_planes();
    exr_storage_t storage{};
    expect(exr_get_storage(context_, first_part, &storage));
    if (storage == EXR_STORAGE_SCANLINE)
      read_lines(planes);
    else if (storage == EXR_STORAGE_TILED)
      read_tiles(planes);
    else
      refuse_openexr(file_, "its pixels have depths");
    return planes;
  }

 private:
  void expect(exr_result_t result) const {
    if (result != EXR_ERR_SUCCESS) refuse_openexr(file_, exr_get_default_error_message(result));
  }

  // OpenEXRCore 3.1 has no DWA, and of B44 wrong numbers where all channels are floats.
  void check_compression() const {
    exr_compression_t compression{};
    expect(exr_get_compression(context_, first_part, &compression));
    if (compression >= EXR_COMPRESSION_B44)
      throw InputError(file_.string() +
                       ": is compressed by B44 or DWA, which lose digits; save it by ZIP, PIZ or without compression");
  }

  OpenexrPlanes empty_planes() {
    expect(exr_get_data_window(context_, first_part, &window_));
    const auto size = [](int first, int last) { return static_cast<std::size_t>(std::int64_t{last} - first + 1); };
    OpenexrPlanes planes;
    planes.columns = size(window_.min.x, window_.max.x), planes.rows = size(window_.min.y, window_.max.y);
    if (planes.columns > most_image_cells || planes.rows > most_image_cells / planes.columns)
      throw InputError(fmt::format("{}: has {} x {} pixels, more than {}; cut it", file_.string(), planes.columns, planes.rows,
                                   most_image_cells));
    const exr_attr_chlist_t* channels = nullptr;
    expect(exr_get_channels(context_, first_part, &channels));
    for (int c = 0; c < channels->num_channels; ++c) {
      if (!fills_all_pixels(channels->entries[c].x_sampling, channels->entries[c].y_sampling)) continue;
      planes.names.emplace_back(channels->entries[c].name.str);
      planes.values.emplace_back(planes.columns * planes.rows);
    }
    return planes;
  }

  void read_lines(OpenexrPlanes& planes) {
    std::int32_t step = 0;
    expect(exr_get_scanlines_per_chunk(context_, first_part, &step));
    exr_chunk_info_t chunk{};
    for (std::size_t line = 0; line < planes.rows; line += static_cast<std::size_t>(step)) {
      expect(exr_read_scanline_chunk_info(context_, first_part, window_.min.y + static_cast<int>(line), &chunk));
      expect(ChunkDecoder(context_, chunk).decode(planes, line * planes.columns));
    }
  }

  void read_tiles(OpenexrPlanes& planes) {
    std::int32_t width = 0, height = 0;
    expect(exr_get_tile_sizes(context_, first_part, full_resolution, full_resolution, &width, &height));
    exr_chunk_info_t chunk{};
    for (std::size_t y = 0; y * height < planes.rows; ++y)
      for (std::size_t x = 0; x * width < planes.columns; ++x) {
        expect(exr_read_tile_chunk_info(context_, first_part, static_cast<int>(x), static_cast<int>(y), full_resolution,
                                        full_resolution, &chunk));
        expect(ChunkDecoder(context_, chunk).decode(planes, y * height * planes.columns + x * width));
      }
  }

  const std::filesystem::path& file_;
  exr_context_t context_ = nullptr;
  exr_attr_box2i_t window_{};
};

}  // namespace

OpenexrPlanes read_openexr_planes(const std::filesystem::path& file) { return OpenexrFile(file).planes(); }

}  // namespace raytube
