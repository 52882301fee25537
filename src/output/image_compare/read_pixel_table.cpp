#include "output/image_compare/read_pixel_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/csv_reader.h"
#include "core/error.h"
#include "output/tables/table_columns.h"

namespace raytube {

namespace {

constexpr const char* readable = "give the path of a readable table, for example out/rcs.csv";

// The two columns that say where a pixel is.
struct PixelColumns {
  const char *across_name, *up_name;
  bool placed;
  ColumnSource across{}, up{};
};

std::optional<PixelColumns> find_pixel_columns(const TableHeader& header) {
  for (PixelColumns columns : {PixelColumns{"u_m", "v_m", true}, PixelColumns{"cross_range_m", "range_m", true},
                               PixelColumns{"col", "row", false}, PixelColumns{"x", "y", false}}) {
    columns.across = header.find(columns.across_name), columns.up = header.find(columns.up_name);
    if (columns.across && columns.up) return columns;
  }
  return std::nullopt;
}

// x and y may as well be places of an antenna.
bool has_looks(const TableHeader& header) {
  const auto there = [&](const char* name) { return static_cast<bool>(header.find(name)); };
  return std::ranges::any_of(std::array{"freq_hz", "freq_ghz", "theta_deg", "phi_deg", "rx_theta_deg", "rx_phi_deg"}, there);
}

TableHeader header_of(const CsvReader& reader, const NamedFile& source) {
  return {reader.location(), reader.columns(), source.map, source.option};
}

// What a row of the table says.
struct Pixel {
  double across, up;
  int transmit;  // 0 for V, 1 for H; with transmit polarisations in rows
  std::array<Complex, 4> s{};
};

bool holds(const ChannelColumns& columns, int channel, int transmit) {
  return columns.channels[channel].any() && (!columns.transmit || channel % 2 == transmit);
}

std::vector<Pixel> read_pixels(CsvReader& reader, const PixelColumns& columns, const ChannelColumns& channels) {
  const std::string place = "write where the pixel is";
  std::vector<Pixel> pixels;
  while (reader.next()) {
    const CsvRow row(reader);
    Pixel& pixel = pixels.emplace_back(Pixel{value_of(row, columns.across, place), value_of(row, columns.up, place),
                                             channels.transmit ? transmit_of(reader, *channels.transmit) : 0});
    for (int c = 0; c < 4; ++c)
      if (holds(channels, c, pixel.transmit)) pixel.s[c] = channel_value(row, channels.channels[c]).s;
  }
  return pixels;
}

EvenAxis axis_of(const std::vector<Pixel>& pixels, double Pixel::*member, const std::string& what, bool placed) {
  std::vector<double> values;
  for (const Pixel& pixel : pixels) values.push_back(pixel.*member);
  std::ranges::sort(values);
  const double same = 1e-6 * (values.back() - values.front()) / static_cast<double>(values.size());
  const auto repeated = std::unique(values.begin(), values.end(), [same](double a, double b) { return b - a <= same; });
  values.erase(repeated, values.end());
  return even_axis(values, what, placed ? "m" : "pixels");
}

std::size_t place_on(const EvenAxis& axis, double value) {
  return axis.count > 1 ? static_cast<std::size_t>(std::lround((value - axis.first) / axis.step)) : 0;
}

// Every pixel once, with each transmit polarisation that there is.
void check_number(const PixelImage& image, const std::vector<Pixel>& pixels) {
  for (const int transmit : {0, 1}) {
    const auto rows = static_cast<std::size_t>(std::ranges::count(pixels, transmit, &Pixel::transmit));
    if (rows != 0 && rows != image.pixels())
      throw InputError(fmt::format("{}: has {} rows for {} x {} pixels; give each pixel of a rectangle once", image.file.string(),
                                   rows, image.across.count, image.up.count));
  }
}

void fill(PixelImage& image, const std::vector<Pixel>& pixels, const ChannelColumns& channels) {
  std::vector<std::array<bool, 2>> seen(image.pixels());
  for (const Pixel& pixel : pixels) {
    const std::size_t index = place_on(image.up, pixel.up) * image.across.count + place_on(image.across, pixel.across);
    if (std::exchange(seen[index][static_cast<std::size_t>(pixel.transmit)], true))
      throw InputError(
          fmt::format("{}: the pixel at {:g}, {:g} stands there twice; remove one", image.file.string(), pixel.across, pixel.up));
    for (int c = 0; c < 4; ++c)
      if (holds(channels, c, pixel.transmit)) {
        image.has_channel[c] = true;
        image.s[c].resize(image.pixels());
        image.s[c][index] = pixel.s[c];
      }
  }
}

}  // namespace

bool is_pixel_table(const NamedFile& source) {
  const CsvReader reader(source.file, readable);
  if (reader.columns().empty()) return false;
  const TableHeader header = header_of(reader, source);
  const std::optional<PixelColumns> columns = find_pixel_columns(header);
  return columns && (columns->across_name != std::string("x") || !has_looks(header));
}

PixelImage read_pixel_table(const NamedFile& source) {
  CsvReader reader(source.file, readable);
  const TableHeader header = header_of(reader, source);
  const std::optional<PixelColumns> columns = find_pixel_columns(header);
  if (header.find("height_m")) header.reject("is an image in space; compare images in a plane, of one angle and frequency");
  const ChannelColumns channels = find_channels(header);
  const std::vector<Pixel> pixels = read_pixels(reader, *columns, channels);
  if (pixels.empty()) header.reject("no rows below the header; nothing can be compared");
  PixelImage image;
  image.file = source.file, image.placed = columns->placed;
  image.across = axis_of(pixels, &Pixel::across, source.file.string() + ": " + columns->across_name, columns->placed);
  image.up = axis_of(pixels, &Pixel::up, source.file.string() + ": " + columns->up_name, columns->placed);
  check_number(image, pixels);
  fill(image, pixels, channels);
  for (int c = 0; c < 4; ++c) image.has_phase[c] = image.has_channel[c] && channels.channels[c].has_phase();
  return image;
}

}  // namespace raytube
