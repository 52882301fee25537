// Pixels of OpenEXR files, however they are stored.
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPartType.h>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/error.h"
#include "openexr_file.h"
#include "output/image_compare/openexr_planes.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Imath::Box2i window({-5, 11}, {61, 51});
constexpr std::size_t columns = 67, rows = 41;

// Numbers that halves hold, too.
std::map<std::string, std::vector<float>> channels_of_a_window() {
  std::map<std::string, std::vector<float>> channels;
  for (std::size_t i = 0; i < columns * rows; ++i) {
    channels["VV.mag"].push_back(static_cast<float>(i % 2039) / 8.0f);
    channels["VV.phase"].push_back(-static_cast<float>(i / columns % 5));
    channels["R"].push_back(static_cast<float>(i % columns));
  }
  return channels;
}

class OpenexrPlanesOfFiles : public ::testing::Test {
 protected:
  std::string complaint(const std::string& bytes) const {
    try {
      read_openexr_planes(scratch.write("damaged.exr", bytes));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  std::string bytes_of(const OpenexrForm& form) const {
    OpenexrWriter(window, channels_of_a_window(), form).write(scratch / "a.exr");
    return text_of(scratch / "a.exr");
  }

  Scratch scratch;
};

TEST_F(OpenexrPlanesOfFiles, AreTheSameFromAllForms) {
  const auto channels = channels_of_a_window();
  const std::vector<std::vector<float>> expected = {channels.at("R"), channels.at("VV.mag"), channels.at("VV.phase")};
  for (const auto compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
                                 Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION})
    for (const auto type : {Imf::FLOAT, Imf::HALF})
      for (const OpenexrForm& form : {OpenexrForm{compression, type}, OpenexrForm{compression, type, 16},
                                      OpenexrForm{compression, type, 16, Imf::MIPMAP_LEVELS}}) {
        OpenexrWriter(window, channels, form).write(scratch / "a.exr");
        const OpenexrPlanes planes = read_openexr_planes(scratch / "a.exr");
        EXPECT_THAT(planes.names, ElementsAre("R", "VV.mag", "VV.phase"));
        EXPECT_EQ(planes.columns, columns);
        EXPECT_EQ(planes.rows, rows);
        EXPECT_EQ(planes.values, expected) << fmt::format("compression {}, type {}, tile {}, levels {}", int{compression},
                                                          int{type}, form.tile, int{form.levels});
      }
}

// Colours may have every second pixel, numbers of objects are whole.
TEST_F(OpenexrPlanesOfFiles, LeaveOutChroma) {
  const Imath::Box2i square({0, 0}, {3, 3});
  Imf::Header header(square, square);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.channels().insert("BY", Imf::Channel(Imf::FLOAT, 2, 2));
  header.channels().insert("id", Imf::Channel(Imf::UINT));
  header.channels().insert("vv", Imf::Channel(Imf::FLOAT));
  const std::vector<unsigned> id(16, 7);
  const std::vector<float> vv(16, 0.1f), chroma(4, 9.0f);
  Imf::FrameBuffer pixels;
  pixels.insert("id", Imf::Slice::Make(Imf::UINT, id.data(), square));
  pixels.insert("vv", Imf::Slice::Make(Imf::FLOAT, vv.data(), square));
  pixels.insert("BY", Imf::Slice::Make(Imf::FLOAT, chroma.data(), square, 0, 0, 2, 2));
  {
    Imf::OutputFile out((scratch / "a.exr").c_str(), header);
    out.setFrameBuffer(pixels);
    out.writePixels(4);
  }
  const OpenexrPlanes planes = read_openexr_planes(scratch / "a.exr");
  EXPECT_THAT(planes.names, ElementsAre("id", "vv"));
  EXPECT_THAT(planes.values, ElementsAre(std::vector<float>(16, 7.0f), vv));
}

TEST_F(OpenexrPlanesOfFiles, DamagedOnesAreRefused) {
  EXPECT_THAT(complaint("EXR"), HasSubstr("damaged.exr: cannot be read as OpenEXR ("));
  for (const OpenexrForm& form : {OpenexrForm{}, OpenexrForm{Imf::ZIP_COMPRESSION}, OpenexrForm{Imf::PIZ_COMPRESSION},
                                  OpenexrForm{Imf::ZIP_COMPRESSION, Imf::HALF, 16}}) {
    const std::string bytes = bytes_of(form);
    ASSERT_EQ(complaint(bytes), "");
    for (const std::size_t part : {1, 4, 9})
      EXPECT_THAT(complaint(bytes.substr(0, bytes.size() * part / 10)), HasSubstr("; give the path of a flat image"));
  }
  std::string torn = bytes_of({Imf::ZIP_COMPRESSION});
  torn.replace(torn.size() / 2, 64, 64, '\xff');
  EXPECT_THAT(complaint(torn), HasSubstr("damaged.exr: cannot be read as OpenEXR ("));
}

TEST_F(OpenexrPlanesOfFiles, OfOtherKindsAreRefused) {
  for (const auto compression : {Imf::B44_COMPRESSION, Imf::DWAA_COMPRESSION})
    EXPECT_THAT(complaint(bytes_of({compression})),
                HasSubstr("damaged.exr: is compressed by B44 or DWA, which lose digits; save it"));

  const auto header = [](int side) {
    Imf::Header made(side, side);
    made.channels().insert("vv", Imf::Channel(Imf::FLOAT));
    made.compression() = Imf::ZIPS_COMPRESSION;
    return made;
  };
  Imf::OutputFile((scratch / "large.exr").c_str(), header(3000));
  EXPECT_THAT(complaint(text_of(scratch / "large.exr")), HasSubstr("has 3000 x 3000 pixels, more than 4000000; cut it"));

  Imf::Header deep = header(4);
  deep.setType(Imf::DEEPSCANLINE);
  Imf::DeepScanLineOutputFile((scratch / "deep.exr").c_str(), deep);
  EXPECT_THAT(complaint(text_of(scratch / "deep.exr")), HasSubstr("(its pixels have depths); give the path of a flat image"));
}

}  // namespace
}  // namespace raytube
