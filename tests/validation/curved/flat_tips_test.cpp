// Flat bodies with tips against an own method of moments (tests/data/mom/leaves.csv).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run.h"
#include "smooth_bodies.h"

namespace raytube {
namespace {

using namespace raytube::testing;

/// Half width and place along x of an outline, from 0 at the one end to 1 at the other.
using HalfOutline = shapes::Meridian;

// Two arcs that meet under `half_angle` to the axis at both ends.
HalfOutline leaf(double half_angle, double length) {
  const double radius = length / 2 / std::sin(half_angle);
  return [=](double x) {
    const double along = length / 2 * std::cos(pi * x);
    const double width = std::sqrt(radius * radius - along * along) - radius * std::cos(half_angle);
    return dvec2(x == 0.0 || x == 1.0 ? 0.0 : width, along);
  };
}

// A half of a leaf of 30 degrees, 2.5 long, and a half of an ellipse, 1.2 long.
HalfOutline drop() {
  const double radius = 2.5 / std::sin(30 * degree), width = radius * (1.0 - std::cos(30 * degree));
  return [=](double x) {
    const double turn = pi * x, along = (x < 0.5 ? 2.5 : 1.2) * std::cos(turn);
    if (x == 0.0 || x == 1.0) return dvec2(0.0, along);
    return dvec2(x < 0.5 ? std::sqrt(radius * radius - along * along) - radius * std::cos(30 * degree) : width * std::sin(turn),
                 along);
  };
}

// The outline in the plane z = 0, along x; sections are ellipses, flatter than wide.
Target flat_body(const HalfOutline& outline, double flatness) {
  PolygonSoup soup = shapes::revolution(outline, shapes::even_rows(80), 96);
  for (dvec3& p : soup.points) p = {p.z, p.x, flatness * p.y};
  return Target(build_mesh(soup, 1.0).mesh);
}

struct Row {
  double theta_deg, phi_deg;
  Complex expected[3], found[3];  // VV, HH, HV
};

std::vector<Row> rows_of(const std::string& body, const Target& target) {
  const Table table(RAYTUBE_SOURCE_DIR "/tests/data/mom/leaves.csv");
  std::vector<Row> rows;
  std::vector<Direction> looks;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (table.text(i, "body") != body) continue;
    const double theta = table.number(i, "theta_deg"), phi = table.number(i, "phi_deg");
    rows.push_back({theta, phi, {table.complex(i, "vv"), table.complex(i, "hh"), table.complex(i, "hv")}, {}});
    looks.push_back({theta * degree, phi * degree});
  }
  const std::vector<ScatteringMatrix> s = solve(target, monostatic(looks, speed_of_light), {}).total;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].found[0] = s[i].vv();
    rows[i].found[1] = s[i].hh();
    rows[i].found[2] = s[i].hv();
  }
  return rows;
}

// Mean |dB| of a cut, levels no lower than 40 dB below its peak.
double error(const std::vector<Row>& rows, double theta_deg, int channel) {
  double peak = 0.0, sum = 0.0;
  int count = 0;
  for (const Row& row : rows)
    if (row.theta_deg == theta_deg) peak = std::max(peak, std::abs(row.expected[channel]));
  const auto level = [&](Complex s) { return 20 * std::log10(std::max(std::abs(s), peak / 100)); };
  for (const Row& row : rows)
    if (row.theta_deg == theta_deg) sum += std::abs(level(row.found[channel]) - level(row.expected[channel])), ++count;
  return sum / count;
}

// Limits are what is measured and a quarter. Without flat tips HH reads 12.8, 5.9 and 5.6 dB in the plane of the rims, 10.7, 6.5
// and 5.4 dB 15 degrees above it, and HV 16.5, 12.9 and 9.3 dB there.
TEST(FlatTips, AgainstTheMethodOfMoments) {
  struct Limit {
    const char* body;
    HalfOutline outline;
    double flatness, hh, hh_above, hv_above;
  };
  for (const Limit& limit :
       {Limit{"leaf 25", leaf(25 * degree, 4.0), 1.0 / 3, 3.4, 4.55, 8.4},
        Limit{"leaf 40", leaf(40 * degree, 4.0), 1.0 / 3, 2.5, 2.15, 4.05}, Limit{"drop", drop(), 0.25, 3.9, 3.45, 5.75}}) {
    const std::vector<Row> rows = rows_of(limit.body, flat_body(limit.outline, limit.flatness));
    const auto expect = [&](double theta_deg, int channel, const char* name, double most) {
      const double found = error(rows, theta_deg, channel);
      measured(fmt::format("{}, theta {}, {}", limit.body, theta_deg, name).c_str(), found, "dB");
      EXPECT_LE(found, most) << limit.body << ' ' << name;
    };
    expect(90, 1, "HH", limit.hh);
    expect(75, 1, "HH", limit.hh_above);
    expect(75, 2, "HV", limit.hv_above);
  }
}

// Rounded edges and tips are those of each frequency. What is left is the noise of what is adaptive; with noses cut where they
// are flat for the lowest frequency rows differed by more than 1 dB.
TEST(FlatTips, DoNotHangOnOtherFrequencies) {
  const Target target = flat_body(leaf(40 * degree, 4.0), 1.0 / 3);
  std::vector<Direction> looks;
  for (const double theta_deg : {90.0, 75.0})
    for (int phi_deg = 0; phi_deg < 90; phi_deg += 15) looks.push_back({theta_deg * degree, phi_deg * degree});
  Sweep sweep = monostatic(looks, speed_of_light);
  const std::vector<ScatteringMatrix> alone = solve(target, sweep, {}).total;
  sweep.frequencies = {speed_of_light / 3, speed_of_light};
  const std::vector<ScatteringMatrix> among = solve(target, sweep, {}).total;
  double worst = 0.0;
  for (std::size_t i = 0; i < looks.size(); ++i)
    for (int p = 0; p < 2; ++p)
      worst = std::max(worst, std::abs(20 * std::log10(std::abs(among[2 * i + 1].at(p, p)) / std::abs(alone[i].at(p, p)))));
  measured("leaf 40, rows beside a third of their frequency and alone", worst, "dB");
  EXPECT_LE(worst, 0.05);
}

}  // namespace
}  // namespace raytube
