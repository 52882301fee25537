// Paths of tubes and hits of facets as files.
#include <gmock/gmock.h>

#include "output/vtk/facet_hits_vtu.h"
#include "output/vtk/image_pvd.h"
#include "output/vtk/tube_paths_vtp.h"
#include "output/words/tubes_text.h"
#include "scratch.h"
#include "vtk_file.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// One tube meets triangles 2 and 0 and leaves, one is absorbed by triangle 2, one was truncated after it.
TubePaths three_tubes() {
  return {8,
          4,
          2,
          8,
          {{1,
            3,
            0.5,
            TubeEnd::left_the_scene,
            {{{0, 0, 9}}, {{0, 0, 1}, 1, 8.0, 0.5, 2}, {{1, 0, 1}, 2, 9.0, 0.25, 0}, {{1, 0, 4}, 2, 12.0, 0.25}}},
           {3, 3, 0.5, TubeEnd::absorbed, {{{0, 1, 9}}, {{0, 1, 1}, 1, 8.0, 0.0, 2}}},
           {5, 3, 0.25, TubeEnd::truncated, {{{0, 2, 9}}, {{0, 2, 1}, 1, 8.0, 1.0, 2}, {{1, 2, 1}, 1, 9.0, 1.0}}}}};
}

TEST(FacetHits, AreCountedByBounce) {
  const FacetHits hits = facet_hits(three_tubes(), 4);
  EXPECT_THAT(hits.at_bounce, ElementsAre(ElementsAre(0, 0, 3, 0), ElementsAre(1, 0, 0, 0)));
  EXPECT_THAT(hits.at_any_bounce(), ElementsAre(1, 0, 3, 0));
}

TEST(FacetHits, OfNoTubesAreNone) { EXPECT_THAT(facet_hits({}, 2).at_bounce, ElementsAre(ElementsAre(0, 0))); }

TEST(TubesText, TellsHowManyOfHowMany) {
  TubePaths tubes = three_tubes();
  EXPECT_EQ(tubes_text(tubes, facet_hits(tubes, 4)),
            "launch grid: 8 columns, 4 rows; 8 of 32 tubes followed, the middle one of every 2 x 2 cells\n"
            "3 of them meet the target\nbounce 1: 3 hits on 1 of 4 facets\nbounce 2: 1 hits on 1 of 4 facets\n"
            "end: 1 left the scene, 1 cut at tubes.max_bounces, 0 lost, 1 absorbed, 0 transmitted\n");
  tubes.stride = 1;
  EXPECT_THAT(tubes_text(tubes, facet_hits(tubes, 4)), HasSubstr("; all 32 tubes followed\n"));
}

TEST(TubePathsVtp, HoldsALineATube) {
  const Scratch scratch;
  write_tube_paths_vtp(scratch / "paths.vtp", three_tubes());
  const std::string text = text_of(scratch / "paths.vtp");
  EXPECT_THAT(text, StartsWith(std::string(tube_paths_head)));
  EXPECT_THAT(text, HasSubstr("NumberOfPoints=\"9\" NumberOfVerts=\"0\" NumberOfLines=\"3\""));
  EXPECT_EQ(vtk_numbers(text, "points").size(), 27u);
  EXPECT_THAT(vtk_numbers(text, "connectivity"), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(vtk_numbers(text, "offsets"), ElementsAre(4, 6, 9));
  EXPECT_THAT(vtk_numbers(text, "bounce"), ElementsAre(0, 1, 2, 2, 0, 1, 0, 1, 1));
  EXPECT_THAT(vtk_numbers(text, "path_length_m"), ElementsAre(0, 8, 9, 12, 0, 8, 0, 8, 9));
  EXPECT_THAT(vtk_numbers(text, "power"), ElementsAre(1, 0.5, 0.25, 0.25, 1, 0, 1, 1, 1));
  EXPECT_THAT(vtk_numbers(text, "triangle"), ElementsAre(-1, 2, 0, -1, -1, 2, -1, 2, -1));
  EXPECT_THAT(vtk_numbers(text, "column"), ElementsAre(1, 3, 5));
  EXPECT_THAT(vtk_numbers(text, "row"), ElementsAre(3, 3, 3));
  EXPECT_THAT(vtk_numbers(text, "bounces"), ElementsAre(2, 1, 1));
  EXPECT_THAT(vtk_numbers(text, "area_m2"), ElementsAre(0.5, 0.5, 0.25));
  EXPECT_THAT(vtk_numbers(text, "power_w"), ElementsAre(0.125, 0, 0.25));
  EXPECT_THAT(vtk_numbers(text, "length_m"), ElementsAre(12, 8, 9));
  EXPECT_THAT(vtk_numbers(text, "end"), ElementsAre(0, 3, 1));
  EXPECT_THAT(vtk_numbers(text, "truncated"), ElementsAre(0, 0, 1));
}

TEST(FacetHitsVtu, HoldsTheTriangles) {
  const Scratch scratch;
  const std::vector<dvec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.25}};
  const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}};
  write_facet_hits_vtu(scratch / "hits.vtu", corners, triangles, facet_hits(three_tubes(), 4));
  const std::string text = text_of(scratch / "hits.vtu");
  EXPECT_THAT(text, StartsWith(std::string(facet_hits_head)));
  EXPECT_THAT(text, HasSubstr("NumberOfPoints=\"4\" NumberOfCells=\"4\""));
  EXPECT_THAT(vtk_numbers(text, "offsets"), ElementsAre(3, 6, 9, 12));
  EXPECT_THAT(vtk_numbers(text, "types"), ElementsAre(5, 5, 5, 5));
  EXPECT_THAT(vtk_numbers(text, "hits"), ElementsAre(1, 0, 3, 0));
  EXPECT_THAT(vtk_numbers(text, "hits_1"), ElementsAre(0, 0, 3, 0));
  EXPECT_THAT(vtk_numbers(text, "hits_2"), ElementsAre(1, 0, 0, 0));
  EXPECT_TRUE(vtk_numbers(text, "hits_3").empty());
}

TEST(ImagePvd, NamesTheFilesInTheirOrder) {
  const Scratch scratch;
  const std::vector<SeriesFile> files{{3, "image_3_mesh.vtu"}, {12, "image_12_mesh.vtu"}};
  write_image_pvd(scratch / "image.pvd", files);
  EXPECT_EQ(text_of(scratch / "image.pvd"),
            "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n"
            "<DataSet timestep=\"3\" group=\"\" part=\"0\" file=\"image_3_mesh.vtu\"/>\n"
            "<DataSet timestep=\"12\" group=\"\" part=\"0\" file=\"image_12_mesh.vtu\"/>\n"
            "</Collection>\n</VTKFile>\n");
}

}  // namespace
}  // namespace raytube
