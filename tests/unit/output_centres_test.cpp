// Scattering centres as a table, and back from it.
#include <gmock/gmock.h>

#include "core/error.h"
#include "output/products/centres_csv.h"
#include "output/products/read_centres_csv.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::HasSubstr;

ScatteringMatrix amplitudes(double size) {
  return {{{{Complex(size, 0.1), Complex(0.2, size)}, {Complex(0.3, 0.4), Complex(-size, 0.0)}}}};
}

ScatteringCentres two_centres() {
  ScatteringCentres found;
  found.centres.push_back({.place = {1.0, -2.5, 0.125},
                           .s = amplitudes(3.0),
                           .triangle = 7u,
                           .band = 0.25,
                           .azimuth = 0.5 * degree,
                           .elevation = degree});
  found.centres.front().shares[1] = 1.0;
  found.centres.push_back({.place = {0.0, 0.5, 0.0}, .s = amplitudes(1.0)});
  found.centres.back().shares[3] = 1.0;
  found.rest = amplitudes(0.5);
  return found;
}

TEST(CentresCsv, IsReadAsItWasWritten) {
  const Scratch scratch;
  const ScatteringCentres found = two_centres();
  write_centres_csv(scratch / "centres.csv", found, {{0.5 * pi, -0.25 * pi}, 2e9, 0.125},
                    [](std::uint32_t triangle) { return triangle == 7 ? "cab, left" : "none"; });
  const StoredCentres read = read_centres_csv(scratch / "centres.csv");
  EXPECT_EQ(read.theta_deg, 90.0);
  EXPECT_EQ(read.phi_deg, -45.0);
  EXPECT_EQ(read.frequency, 2e9);
  EXPECT_EQ(read.side, 0.125);
  ASSERT_EQ(read.centres.size(), 2u);
  const StoredCentre& first = read.centres.front();
  EXPECT_EQ(first.place, found.centres.front().place);
  EXPECT_EQ(first.s.s, found.centres.front().s.s);
  EXPECT_EQ(first.mechanism, "bounce_2");
  EXPECT_EQ(first.part, "cab, left");
  EXPECT_EQ(first.persistence_ghz, 0.5);
  EXPECT_EQ(first.persistence_elevation_deg, 1.0);
  EXPECT_EQ(read.centres.back().part, "");
  EXPECT_LT(frobenius_norm(read.s - found.centres[0].s - found.centres[1].s - found.rest), 1e-14);  // rounding of sums
}

TEST(CentresCsv, WhatIsNoneIsRefused) {
  const Scratch scratch;
  const std::string head = "# Scattering centres of the look theta 90, phi 0 degrees at 1e9 Hz, resolved to cubes of 1 m.\n";
  const auto complaint = [&](const std::string& text) -> std::string {
    try {
      read_centres_csv(scratch.write("centres.csv", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint("centre,x_m\n"), HasSubstr("centres.csv: does not begin as raytube centres writes it"));
  EXPECT_THAT(complaint(head + "centre,x_m\n1,2\n"), HasSubstr("centres.csv: has no column re_vv; run raytube centres again"));
}

}  // namespace
}  // namespace raytube
