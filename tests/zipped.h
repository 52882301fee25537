// Archives as 3MF files are, without compression.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace raytube::testing {

/// Files by name and contents (PKWARE, APPNOTE.TXT, sections 4.3.7, 4.3.12 and 4.3.16).
inline std::string zipped(const std::vector<std::pair<std::string, std::string>>& files) {
  const auto little = [](std::uint64_t value, int bytes) {
    std::string text;
    for (; bytes > 0; --bytes, value >>= 8) text += static_cast<char>(value & 0xFF);
    return text;
  };
  std::string archive, directory;
  for (const auto& [name, text] : files) {
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
    const std::string common = little(20, 2) + std::string(8, '\0') + little(sum, 4) + little(text.size(), 4) +
                               little(text.size(), 4) + little(name.size(), 2) + little(0, 2);
    directory += "PK\x01\x02" + little(20, 2) + common + std::string(10, '\0') + little(archive.size(), 4) + name;
    archive += "PK\x03\x04" + common + name + text;
  }
  const std::uint64_t begin = archive.size();
  return archive + directory + "PK\x05\x06" + std::string(4, '\0') + little(files.size(), 2) + little(files.size(), 2) +
         little(directory.size(), 4) + little(begin, 4) + little(0, 2);
}

/// A 3MF file with this model.
inline std::string packed_3mf(const std::string& model, const std::vector<std::pair<std::string, std::string>>& further = {}) {
  std::vector<std::pair<std::string, std::string>> files = {
      {"_rels/.rels",
       "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Id=\"r\" "
       "Target=\"/3D/3dmodel.model\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
      {"3D/3dmodel.model", model}};
  files.insert(files.end(), further.begin(), further.end());
  return zipped(files);
}

}  // namespace raytube::testing
