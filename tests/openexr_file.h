// An OpenEXR file as its specification has it: scan lines of floats, not compressed.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace raytube::testing {

class OpenexrBytes {
 public:
  /// Channels by name, from the top line on.
  OpenexrBytes(int columns, int rows, const std::map<std::string, std::vector<float>>& channels) {
    add<std::uint32_t>(20000630), add<std::uint32_t>(2);
    add_header(columns, rows, channels);
    const auto line_bytes = static_cast<std::uint32_t>(4 * columns * static_cast<int>(channels.size()));
    const std::uint64_t first = bytes_.size() + 8 * static_cast<std::uint64_t>(rows);
    for (int y = 0; y < rows; ++y) add<std::uint64_t>(first + static_cast<std::uint64_t>(y) * (8 + line_bytes));
    for (int y = 0; y < rows; ++y) {
      add<std::int32_t>(y), add(line_bytes);
      for (const auto& [name, values] : channels)
        for (int x = 0; x < columns; ++x) add(values[static_cast<std::size_t>(y * columns + x)]);
    }
  }

  const std::string& text() const { return bytes_; }

 private:
  template <class Number>
  void add(Number value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void add_text(const std::string& text) { bytes_ += text + '\0'; }
  void add_attribute(const std::string& name, const std::string& type, std::size_t size) {
    add_text(name), add_text(type), add(static_cast<std::int32_t>(size));
  }
  void add_box(const std::string& name, int columns, int rows) {
    add_attribute(name, "box2i", 16);
    for (const int corner : {0, 0, columns - 1, rows - 1}) add<std::int32_t>(corner);
  }

  void add_header(int columns, int rows, const std::map<std::string, std::vector<float>>& channels) {
    std::size_t size = 1;
    for (const auto& [name, values] : channels) size += name.size() + 17;
    add_attribute("channels", "chlist", size);
    for (const auto& [name, values] : channels) {
      add_text(name), add<std::int32_t>(2), add<std::int32_t>(0), add<std::int32_t>(1), add<std::int32_t>(1);
    }
    bytes_ += '\0';
    add_attribute("compression", "compression", 1), bytes_ += '\0';
    add_box("dataWindow", columns, rows), add_box("displayWindow", columns, rows);
    add_attribute("lineOrder", "lineOrder", 1), bytes_ += '\0';
    add_attribute("pixelAspectRatio", "float", 4), add(1.0f);
    add_attribute("screenWindowCenter", "v2f", 8), add(0.0f), add(0.0f);
    add_attribute("screenWindowWidth", "float", 4), add(1.0f);
    bytes_ += '\0';
  }

  std::string bytes_;
};

}  // namespace raytube::testing
