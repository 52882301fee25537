// Scattering centres as a table.
#include <gmock/gmock.h>

#include "output/products/centres_csv.h"
#include "run.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::HasSubstr;

ScatteringMatrix amplitudes(double size) {
  return {{{{Complex(size, 0.1), Complex(0.2, size)}, {Complex(0.3, 0.4), Complex(-size, 0.0)}}}};
}

ScatteringCentres two_centres() {
  ScatteringCentres found{.centres = {}, .rest = {}, .mechanisms = {"bounce_1", "bounce_2", "bounce_3_on", "edges"}};
  found.centres.push_back({.place = {1.0, -2.5, 0.125},
                           .s = amplitudes(3.0),
                           .shares = {0.0, 1.0, 0.0, 0.0},
                           .triangle = 7u,
                           .band = 0.25,
                           .azimuth = 0.5 * degree,
                           .elevation = degree});
  found.centres.push_back({.place = {0.0, 0.5, 0.0}, .s = amplitudes(1.0), .shares = {0.0, 0.0, 0.0, 1.0}});
  found.rest = amplitudes(0.5);
  return found;
}

TEST(CentresCsv, RowsHoldPlacesAmplitudesAndMechanisms) {
  const Scratch scratch;
  const ScatteringCentres found = two_centres();
  write_centres_csv(scratch / "centres.csv", found, {{0.5 * pi, -0.25 * pi}, 2e9, 0.125},
                    [](std::uint32_t triangle) { return triangle == 7 ? "cab" : "none"; });
  EXPECT_THAT(text_of(scratch / "centres.csv"), HasSubstr("look theta 90, phi -45 degrees at "));
  const Table read((scratch / "centres.csv").string());
  ASSERT_EQ(read.rows(), 3u);  // and the rest
  EXPECT_EQ(read.number(0, "x_m"), 1.0);
  EXPECT_EQ(read.number(0, "y_m"), -2.5);
  EXPECT_EQ(read.number(0, "z_m"), 0.125);
  EXPECT_EQ(read.complex(0, "hv"), found.centres.front().s.at(1, 0));
  EXPECT_EQ(read.text(0, "mechanism"), "bounce_2");
  EXPECT_EQ(read.number(0, "persistence_ghz"), 0.5);
  EXPECT_EQ(read.number(0, "persistence_elevation_deg"), 1.0);
  EXPECT_EQ(read.text(2, "centre"), "rest");
  EXPECT_EQ(read.complex(2, "vv"), found.rest.vv());
}

}  // namespace
}  // namespace raytube
