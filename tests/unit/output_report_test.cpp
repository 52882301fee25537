// Data of a report made small: nothing that is seen gets lost.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "output/report/blocks.h"
#include "output/report/packed.h"
#include "output/report/page.h"
#include "output/report/shown_mesh.h"
#include "output/report/sweep_json.h"

namespace raytube {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double infinite = std::numeric_limits<double>::infinity();

std::string bytes_of(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c)), held += 6;
    if (held >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 255);
  }
  return bytes;
}

template <class Number>
std::vector<Number> unpacked(const std::string& base64) {
  const std::string bytes = bytes_of(base64);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

TEST(Packed, AsOtherProgramsUnpackIt) {
  EXPECT_EQ(packed_levels({-infinite, 0.0, 1.5}), "AIAAAJYA");  // by Python's struct and base64
  EXPECT_THAT(unpacked<std::int16_t>(packed_levels({-327.69, -327.67, 400.0, std::nan("")})),
              testing::ElementsAre(-32768, -32767, 32767, -32768));
  EXPECT_THAT(unpacked<float>(packed_floats({1.0, -2.5})), testing::ElementsAre(1.0f, -2.5f));
  EXPECT_THAT(unpacked<std::uint32_t>(packed_indices({7, 1u << 31})), testing::ElementsAre(7u, 1u << 31));
}

TEST(BlockLevels, ABlockHasTheStrongest) {
  BlockLevels levels(Blocks(3, 2), Blocks(5, 2));  // 2 x 2 blocks of 2 x 3
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 5; ++j) levels.add(i, j, std::array{double(10 * i + j), -infinite, 0.0, 1.0});
  EXPECT_THAT(unpacked<std::int16_t>(levels.json().items[0].text), testing::ElementsAre(1200, 1400, 2200, 2400));
}

/// A square of n x n cells, two triangles each.
struct Sheet {
  std::vector<dvec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  explicit Sheet(std::uint32_t n) {
    for (std::uint32_t i = 0; i <= n; ++i)
      for (std::uint32_t j = 0; j <= n; ++j) vertices.emplace_back(double(i) / n, double(j) / n, 0.3);
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; j < n; ++j) {
        const std::uint32_t a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
        triangles.push_back({a, c, d});
        triangles.push_back({a, d, b});
      }
  }
};

double area(const ShownMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * glm::length(glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
  return sum;
}

TEST(ShownMesh, ASmallOneStaysAsItIs) {
  const Sheet sheet(3);
  const ShownMesh mesh = shown_mesh(sheet.vertices, sheet.triangles, 18);
  EXPECT_EQ(mesh.triangles, sheet.triangles);
  for (std::uint32_t i = 0; i < 18; ++i) EXPECT_EQ(mesh.shown_as[i], i);
}

// A flat sheet loses half a cell at its rim, and each of its triangles has one that stands for it nearby.
TEST(ShownMesh, ALargeOneKeepsItsShape) {
  const Sheet sheet(100);
  const ShownMesh mesh = shown_mesh(sheet.vertices, sheet.triangles, 2000);
  EXPECT_LE(mesh.triangles.size(), 2000u);
  EXPECT_GT(mesh.triangles.size(), 1000u);
  const double cell = std::sqrt(2.0 / static_cast<double>(mesh.triangles.size()));
  EXPECT_NEAR(area(mesh), 1.0, 2.5 * cell);
  ASSERT_EQ(mesh.shown_as.size(), sheet.triangles.size());
  for (std::size_t i = 0; i < mesh.shown_as.size(); ++i) {
    const dvec3 far = mesh.vertices[mesh.triangles[mesh.shown_as[i]][0]] - sheet.vertices[sheet.triangles[i][0]];
    EXPECT_LT(glm::length(far), 4.0 * cell) << i;
  }
}

StoredResult long_sweep(std::size_t rows) {
  StoredResult result;
  result.frequency_hz = {1e10};
  for (std::size_t i = 0; i < rows; ++i) {
    const double phi = 0.001 * static_cast<double>(i), level = std::sin(0.1 * static_cast<double>(i));
    result.looks.push_back({90.0, phi, 90.0, phi});
    result.s.push_back({});
    result.sigma_dbsm.push_back({{{level, -60.0}, {-60.0, level - 1.0}}});
    result.err_db.push_back({});
    result.model_db.push_back({});
  }
  return result;
}

TEST(SweepJson, ALongSweepKeepsItsPeaksAndNulls) {
  StoredResult result = long_sweep(120'000);
  result.sigma_dbsm[77'777][0][0] = 40.0;
  result.sigma_dbsm[33'333] = {{{-90.0, -90.0}, {-90.0, -90.0}}};
  const auto rows = unpacked<std::uint32_t>(sweep_json(result).find("rows")->text);
  EXPECT_LE(rows.size(), 50'000u);
  EXPECT_GT(rows.size(), 30'000u);
  EXPECT_TRUE(std::ranges::is_sorted(rows));
  EXPECT_TRUE(std::ranges::binary_search(rows, 77'777u));
  EXPECT_TRUE(std::ranges::binary_search(rows, 33'333u));
}

TEST(ReportPage, DataCannotEndTheirScript) {
  JsonValue data;
  data["title"] = "</script><!-- ";
  const std::string page = report_page(data, "a < b & c", "THREE_IS_HERE");
  EXPECT_THAT(page, AllOf(HasSubstr("<title>a &lt; b &amp; c</title>"), HasSubstr("\\u003c/script>\\u003c!-- "),
                          HasSubstr("THREE_IS_HERE"), HasSubstr("buildPage();"), Not(HasSubstr("@data@"))));
  EXPECT_EQ(page.compare(0, report_head.size(), report_head), 0);
}

}  // namespace
}  // namespace raytube
