// Images beside each other: what is read, how they are registered and measured.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>

#include "core/error.h"
#include "openexr_file.h"
#include "output/image_compare/image_report.h"
#include "output/image_compare/read_image.h"
#include "output/image_compare/registration.h"
#include "output/image_compare/structural_similarity.h"
#include "output/products/isar_csv.h"
#include "output/products/isar_netcdf.h"
#include "run.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::HasSubstr;

// Three Gaussian spots, 2.5 pixels wide, with a phase of their own.
Complex spots(double x, double y) {
  Complex sum = 0.0;
  for (const auto& [px, py, size] : {std::array{14.0, 11.0, 1.0}, {24.0, 18.0, 0.6}, {18.0, 26.0, 0.3}})
    sum += std::polar(size * std::exp(-((x - px) * (x - px) + (y - py) * (y - py)) / 12.5), px);
  return sum;
}

constexpr std::size_t columns = 40, rows = 36;

// VV of the spots, whose pixels count from `origin`.
PixelImage image_of(const dvec2& origin, double factor = 1.0, std::size_t nx = columns, std::size_t ny = rows) {
  PixelImage image{"spots", false, {0.0, 1.0, nx}, {0.0, 1.0, ny}, {true}, {true}, {}};
  for (std::size_t y = 0; y < ny; ++y)
    for (std::size_t x = 0; x < nx; ++x)
      image.s[0].push_back(factor * spots(static_cast<double>(x) + origin.x, static_cast<double>(y) + origin.y));
  return image;
}

std::vector<double> magnitudes_of(const PixelImage& image) {
  std::vector<double> values;
  for (const Complex s : image.s[0]) values.push_back(std::abs(s));
  return values;
}

// What is asked is 0.02 pixel; Gaussian spots are all but free of higher waves.
TEST(Registration, FindsShiftsBetweenPixels) {
  const std::vector<double> reference = magnitudes_of(image_of({0.0, 0.0}));
  for (const dvec2 shift : {dvec2(0.0, 0.0), dvec2(1.37, -0.62), dvec2(-4.5, 3.25), dvec2(0.03, 0.0), dvec2(7.0, -4.0)}) {
    const dvec2 found = best_shift({{magnitudes_of(image_of(-shift)), reference}}, columns, rows);
    EXPECT_NEAR(found.x, shift.x, 0.02);
    EXPECT_NEAR(found.y, shift.y, 0.02);
  }
}

// Two windows of one picture that fills both to the border: nothing but what both show decides.
TEST(Registration, OfPicturesThatFillTheirFrames) {
  constexpr std::size_t size = 40;
  const auto window = [](double right, double up) {
    std::vector<double> values;
    for (std::size_t row = 0; row < size; ++row)
      for (std::size_t column = 0; column < size; ++column) {
        const double x = static_cast<double>(column) + right, y = static_cast<double>(row) + up;
        values.push_back(2.0 + std::sin(1.31 * x + 0.02 * x * x) * std::cos(0.83 * y) + std::sin(0.017 * x * y));
      }
    return values;
  };
  const dvec2 found = best_shift({{window(-3.0, 2.0), window(0.0, 0.0)}}, size, size);
  EXPECT_NEAR(found.x, 3.0, 0.002);
  EXPECT_NEAR(found.y, -2.0, 0.002);
}

TEST(Registration, OfALineIsAlongIt) {
  std::vector<double> a(50), b(50);
  for (int i = 0; i < 50; ++i) a[i] = std::exp(-0.1 * (i - 22.4) * (i - 22.4)), b[i] = std::exp(-0.1 * (i - 20.0) * (i - 20.0));
  EXPECT_NEAR(best_shift({{a, b}}, 50, 1).x, 2.4, 0.02);
  EXPECT_EQ(best_shift({{a, b}}, 50, 1).y, 0.0);
}

// Two pixels by hand, with w = exp(-1 / 4.5) and p = 1 / (1 + w): means 14.44672 and 15.55328, covariance -24.6939, variances
// 49.3878 together; L = 40.
TEST(StructuralSimilarity, IsThatOfWangByHand) {
  const std::vector<double> a{10.0, 20.0}, b{20.0, 10.0};
  EXPECT_NEAR(structural_similarity(a, b, 2, 40.0), -0.94078, 1e-5);
  EXPECT_NEAR(structural_similarity(a, b, 1, 40.0), -0.94078, 1e-5);
  EXPECT_EQ(structural_similarity(a, a, 2, 40.0), 1.0);
}

// Without variance luminance is left: (2 x y + C1) / (x^2 + y^2 + C1).
TEST(StructuralSimilarity, OfEvenImagesIsThatOfTheirLevels) {
  const std::vector<double> a(200, 30.0), b(200, 20.0), nothing(200, 0.0);
  EXPECT_NEAR(structural_similarity(a, b, 20, 40.0), (1200.0 + 0.16) / (1300.0 + 0.16), 1e-12);
  EXPECT_EQ(structural_similarity(nothing, nothing, 20, 40.0), 1.0);
}

TEST(ImageComparison, OfOneImageIsZero) {
  const ImageComparison c = compare_images(image_of({0, 0}), image_of({0, 0}));
  const ImageMeasures& m = c.measures[0];
  EXPECT_EQ(c.shift, dvec2(0.0));
  EXPECT_EQ(m.errors.rms_db, 0.0);
  EXPECT_EQ(m.errors.relative_error, 0.0);
  EXPECT_EQ(m.magnitude_error, 0.0);
  EXPECT_EQ(m.power_ratio_db, 0.0);
  EXPECT_EQ(m.similarity, 1.0);
  EXPECT_NEAR(m.correlation, 1.0, 1e-15);
  EXPECT_EQ(relative_error(c), 0.0);
}

// Amplitudes twice as large are 6.02 dB and an error of 1.
TEST(ImageComparison, MeasuresAFactor) {
  const ImageComparison c = compare_images(image_of({0, 0}, 2.0), image_of({0, 0}));
  const ImageMeasures& m = c.measures[0];
  const double six = 20.0 * std::log10(2.0);
  for (const double db : {m.errors.rms_db, m.errors.bias_db, m.errors.median_abs_db, m.power_ratio_db})
    EXPECT_NEAR(db, six, 1e-12);
  EXPECT_NEAR(m.errors.relative_error, 1.0, 1e-12);
  EXPECT_NEAR(m.magnitude_error, 1.0, 1e-12);
  EXPECT_NEAR(m.correlation, 1.0, 1e-12);
  EXPECT_LT(m.similarity, 0.99);
  EXPECT_EQ(above_tolerance(c, 6.0), "vv 6.021 dB");
  EXPECT_EQ(above_tolerance(c, 6.1), "");
}

TEST(ImageComparison, FreeScaleTakesAFactorAway) {
  PixelImage turned = image_of({0, 0}, 3.0);
  for (Complex& s : turned.s[0]) s *= std::polar(1.0, 0.7);
  const ImageComparison c = compare_images(turned, image_of({0, 0}), {.free_scale = true});
  EXPECT_NEAR(std::abs(c.scale->factor - std::polar(1.0 / 3.0, -0.7)), 0.0, 1e-14);
  EXPECT_NEAR(c.measures[0].errors.relative_error, 0.0, 1e-14);
  EXPECT_NEAR(c.measures[0].errors.rms_db, 0.0, 1e-12);
  turned.has_phase[0] = false;  // of magnitudes the factor is positive
  const ImageComparison magnitudes = compare_images(turned, image_of({0, 0}), {.free_scale = true});
  EXPECT_NEAR(std::abs(magnitudes.scale->factor - 1.0 / 3.0), 0.0, 1e-14);
  EXPECT_NEAR(magnitudes.measures[0].magnitude_error, 0.0, 1e-14);
  EXPECT_TRUE(std::isnan(magnitudes.measures[0].errors.relative_error));
  EXPECT_TRUE(std::isinf(relative_error(magnitudes)));
}

// Whole pixels are exact; between them cubic convolution errs by the third power of the step over the spots' width.
TEST(ImageComparison, TakesAShiftBack) {
  const ImageComparison whole = compare_images(image_of({-3.0, 2.0}), image_of({0, 0}));
  EXPECT_EQ(whole.shift, dvec2(3.0, -2.0));
  EXPECT_EQ(whole.pixels(), (columns - 3) * (rows - 2));
  EXPECT_EQ(whole.measures[0].errors.relative_error, 0.0);
  const ImageComparison between = compare_images(image_of({-1.4, 0.0}), image_of({0, 0}));
  EXPECT_NEAR(between.shift.x, 1.4, 0.02);
  EXPECT_LT(between.measures[0].errors.relative_error, 0.02);
  EXPECT_GT(between.measures[0].similarity, 0.99);
}

// Images of a radar turn their phase by a whole wave or more from pixel to pixel.
TEST(ImageComparison, TakesAShiftBackWhateverPhasesRun) {
  PixelImage result = image_of({-1.4, 0.0}), reference = image_of({0, 0});
  for (std::size_t i = 0; i < result.pixels(); ++i) {
    const double x = static_cast<double>(i % columns), y = static_cast<double>(i / columns);
    result.s[0][i] *= std::polar(1.0, -2.2 * (x - 1.4) + 1.9 * y);
    reference.s[0][i] *= std::polar(1.0, -2.2 * x + 1.9 * y);
  }
  EXPECT_LT(compare_images(result, reference).measures[0].errors.relative_error, 0.03);
}

TEST(ImageComparison, LeavesImagesWhereTheyAreIfAsked) {
  const ImageComparison c = compare_images(image_of({-3.0, 2.0}), image_of({0, 0}), {.registered = false});
  EXPECT_EQ(c.pixels(), columns * rows);
  EXPECT_GT(c.measures[0].errors.relative_error, 0.5);
  EXPECT_THAT(comparison_text(c), HasSubstr("registered  no (--no-register)"));
}

TEST(ImageComparison, OfPlacedImagesIsOverTheirOverlap) {
  PixelImage result = image_of({4.0, 1.0}, 1.0, 30, 34), reference = image_of({0, 0});
  result.placed = reference.placed = true;
  result.across = {0.4, 0.1, 30}, result.up = {0.1, 0.1, 34};
  reference.across.step = reference.up.step = 0.1;
  const ImageComparison c = compare_images(result, reference);
  EXPECT_EQ(c.pixels(), 30u * 34u);
  EXPECT_EQ(c.shift, dvec2(0.0));
  EXPECT_EQ(c.measures[0].errors.relative_error, 0.0);
  EXPECT_THAT(comparison_text(c), HasSubstr("compared    30 x 34 pixels of the reference"));
}

TEST(ImageComparison, OfPlacedImagesMayHavePixelsOfOtherSizes) {
  PixelImage reference = image_of({0, 0}), result = reference;
  result.placed = reference.placed = true;
  result.across = {0.0, 0.5, 2 * columns}, result.up = {0.0, 0.5, 2 * rows};
  result.s[0].clear();
  for (std::size_t y = 0; y < 2 * rows; ++y)
    for (std::size_t x = 0; x < 2 * columns; ++x)
      result.s[0].push_back(spots(0.5 * static_cast<double>(x), 0.5 * static_cast<double>(y)));
  EXPECT_NEAR(compare_images(result, reference).measures[0].errors.relative_error, 0.0, 1e-12);
  const ImageComparison back = compare_images(reference, result);
  EXPECT_EQ(back.pixels(), (2 * columns - 1) * (2 * rows - 1));
  EXPECT_LT(back.measures[0].errors.relative_error, 0.02);
}

// A pixel that no sample met is 80 dB down, not endlessly far.
TEST(ImageComparison, PixelsWithoutSamplesStayFinite) {
  PixelImage result = image_of({0, 0});
  result.s[0][11 * columns + 14] = 0.0;  // the brightest one
  const ImageComparison c = compare_images(result, image_of({0, 0}), {.registered = false});
  EXPECT_NEAR(c.measures[0].errors.largest_abs_db, 80.0, 1e-9);
  EXPECT_EQ(c.measures[0].errors.largest_row, 11 * columns + 14);
}

TEST(ImageComparison, TellsOfChannelsThatOneImageLacks) {
  PixelImage result = image_of({0, 0}), reference = result;
  result.has_channel[3] = true, result.s[3] = result.s[0];
  reference.has_channel[1] = result.has_channel[1] = true;
  result.s[1] = result.s[0], reference.s[1].assign(reference.pixels(), 0.0);
  const ImageComparison c = compare_images(result, reference);
  EXPECT_THAT(comparison_text(c), HasSubstr("hh: in the result alone\n"));
  EXPECT_THAT(comparison_text(c), HasSubstr("vh: no signal in the reference (peak -inf dBsm)"));
  EXPECT_EQ(above_tolerance(c, 1.0), "vh inf dB");
}

class ImageFiles : public ::testing::Test {
 protected:
  PixelImage read(const std::string& name, const std::string& bytes, const std::string& columns_of_it = "") const {
    return read_image(
        {scratch.write(name, bytes), parsed_column_map("--reference-columns", columns_of_it), "--reference-columns"});
  }
  std::string complaint(const std::string& name, const std::string& bytes, const std::string& columns_of_it = "") const {
    try {
      read(name, bytes, columns_of_it);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  Scratch scratch;
};

TEST_F(ImageFiles, TablesOfPixelsInAnyOrder) {
  const PixelImage image = read("a.csv", "col,row,re_vv,im_vv\n1,0,3,4\n0,0,1,2\n0,1,5,6\n1,1,7,8\n");
  EXPECT_FALSE(image.placed);
  EXPECT_EQ(image.s[0], (std::vector<Complex>{{1, 2}, {3, 4}, {5, 6}, {7, 8}}));
  EXPECT_TRUE(image.has_phase[0]);
  EXPECT_FALSE(image.has_channel[3]);
}

// Rows from the top, magnitudes and phases by transmit polarisation, names of their own.
TEST_F(ImageFiles, TablesOfARenderer) {
  const PixelImage image =
      read("a.csv", "px,py,pol,mag_v,ph_v,mag_h,ph_h\n0,0,v,2,0,0,0\n0,1,v,1,0,3,90\n0,0,h,0,0,4,0\n0,1,h,0,0,5,180\n",
           "x=px,y=py*-1+1,tx_pol=pol,v_magnitude=mag_v,v_phase_rad=ph_v*0.017453292519943295,"
           "h_magnitude=mag_h,h_phase_rad=ph_h*0.017453292519943295");
  ASSERT_EQ(image.pixels(), 2u);
  const double unit = 1.0 / std::sqrt(4.0 * pi);
  EXPECT_NEAR(std::abs(image.s[0][0] - 1.0 * unit), 0.0, 1e-15);
  EXPECT_NEAR(std::abs(image.s[2][0] - Complex(0.0, 3.0 * unit)), 0.0, 1e-15);  // hv
  EXPECT_NEAR(std::abs(image.s[3][0] + 5.0 * unit), 0.0, 1e-15);
  EXPECT_NEAR(std::abs(image.s[0][1] - 2.0 * unit), 0.0, 1e-15);
}

TEST_F(ImageFiles, OfIsarAreTheSameFromBothForms) {
  IsarImage image;
  image.axes.resize(2);
  image.grid = {{3, 2, 1}, {0.5, 0.25, 1.0}};
  for (int i = 0; i < 6; ++i) image.s.push_back({{{{Complex(i, 1.0), 0.1}, {Complex(0.0, 0.2), Complex(0.5 * i)}}}});
  StoredResult stored;
  stored.frequency_hz = {1e9}, stored.looks.resize(1);
  write_isar_csv(scratch / "isar.csv", image, {});
  write_isar_netcdf(scratch / "isar.nc", stored, image, {});
  ASSERT_TRUE(are_images({.file = scratch / "isar.csv"}, {.file = scratch / "isar.nc"}));
  for (const char* name : {"isar.csv", "isar.nc"}) {
    const PixelImage read = read_image({.file = scratch / name});
    ASSERT_EQ(read.up.count, 3u);
    ASSERT_EQ(read.across.count, 2u);
    EXPECT_TRUE(read.placed);
    EXPECT_NEAR(read.across.step, 0.25, 1e-12);
    EXPECT_EQ(read.s[0][3], Complex(3.0, 1.0));
    EXPECT_EQ(read.s[3][5], Complex(2.5, 0.0));
    EXPECT_EQ(read.s[2][0], Complex(0.0, 0.2));
  }
}

// Lines of the file run downwards, those of the image upwards.
TEST_F(ImageFiles, OpenexrOfARenderer) {
  OpenexrWriter({{0, 0}, {1, 1}}, {{"VV.mag", {1, 2, 3, 4}}, {"VV.phase", {0, 0, 0.5f, 0}}, {"R", {9, 9, 9, 9}}})
      .write(scratch / "a.exr");
  const std::string bytes = text_of(scratch / "a.exr");
  const PixelImage image = read("a.exr", bytes, "magnitude_vv=VV.mag,phase_vv_rad=VV.phase");
  const double unit = 1.0 / std::sqrt(4.0 * pi);
  ASSERT_EQ(image.pixels(), 4u);
  EXPECT_NEAR(std::abs(image.s[0][0] - std::polar(3.0 * unit, 0.5)), 0.0, 1e-15);
  EXPECT_NEAR(std::abs(image.s[0][3] - 2.0 * unit), 0.0, 1e-15);
  EXPECT_THAT(complaint("a.exr", bytes), HasSubstr("a.exr: no channel; name at least re_vv and im_vv"));
  EXPECT_THAT(complaint("a.exr", bytes, "magnitude_vv=HH"), HasSubstr("no column is named hh; choose among r, vv.mag, vv.phase"));
  OpenexrWriter({{0, 0}, {0, 1}}, {{"magnitude_vv", {1, std::numeric_limits<float>::quiet_NaN()}}})
      .write(scratch / "endless.exr");
  EXPECT_THAT(complaint("a.exr", text_of(scratch / "endless.exr")),
              HasSubstr("a.exr, column 0 of line 1, magnitude_vv: is not a finite number; write"));
}

}  // namespace
}  // namespace raytube
