// Records of a mesh file that may carry surface, though no reader knows them: read, refused or counted aloud, never lost.
#include <gmock/gmock.h>

#include <cmath>

#include "core/error.h"
#include "jobs/inputs.h"
#include "mesh/read/formats.h"
#include "scratch.h"
#include "unit/mesh_shapes.h"

namespace raytube::shapes {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::Scratch;

PolygonSoup read(const std::string& name, const std::string& bytes) {
  const Scratch scratch;
  return read_polygon_soup(scratch.write(name, bytes));
}

std::string complaint(const std::string& name, const std::string& bytes) {
  try {
    read(name, bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(MeshReadLosses, ObjFacetsOfOlderFilesAndFlawedOnes) {
  EXPECT_EQ(read("a.obj", corners + "f 1 2 3\nfo 1 3 4\n").polygons, (std::vector<Polygon>{{0, 1, 2}, {0, 2, 3}}));
  for (const char* line : {"F 1 3 4", "f1 3 4", "f\xC2\xA0 1 3 4",
                           "\xC2\xA0"
                           "f 1 3 4",
                           "V 2 2 2", "f,1,3,4"})
    EXPECT_THAT(complaint("a.obj", corners + "f 1 2 3\n" + line + "\n"), HasSubstr("line 6: '")) << line;
}

TEST(MeshReadLosses, ObjUnknownStatementsAreCounted) {
  const PolygonSoup soup = read("a.obj", corners + "f 1 2 3\nface 1 3 4\nvn 0 0 1\ncall other.obj\n");
  EXPECT_THAT(soup.remarks,
              ElementsAre(HasSubstr("2 lines left out whose statement is none of OBJ, the first 'face' on line 6")));
  EXPECT_THAT(read("a.obj", corners + "s off\nmtllib C:\\x\\\nvp 1\nvn 0 0 \\\n1\nf 1 2 3\n").remarks, IsEmpty());
}

TEST(MeshReadLosses, ObjBackslashSwallowsNoStatement) {
  for (const char* line : {"g path\\", "l 1 2\\", "f 1 2 3\\"})
    EXPECT_THAT(complaint("a.obj", corners + line + "\nf 1 3 4\nf 1 2 3\n"),
                HasSubstr("line 6: 'f' continues the line before, which ends in a backslash"))
        << line;
}

TEST(MeshReadLosses, PlyStripsAndOtherItems) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string facet = "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_THAT(complaint("a.ply", head + "element tristrips 1\nproperty list int int vertex_indices\n" + facet + "3 2 1 0\n"),
              HasSubstr("its surface is in 1 'tristrips', of which faces alone are read"));
  EXPECT_THAT(
      read("a.ply", head + "element patch 1\nproperty int x\nelement edge 1\nproperty int x\n" + facet + "7\n7\n").remarks,
      ElementsAre(HasSubstr("1 items 'patch' left out")));
  EXPECT_THAT(complaint("a.ply", head + "Element face 1\n" + facet), HasSubstr("line 9: 'Element' is no word of a PLY header"));
}

TEST(MeshReadLosses, StlOnOneLineOrPadded) {
  const std::string facet = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet ";
  const PolygonSoup soup = read("a.stl", "solid nose cone " + facet + facet + "endsolid nose cone solid " + facet + "endsolid");
  EXPECT_EQ(soup.polygons.size(), 3u);
  EXPECT_THAT(soup.names.all(), ElementsAre("nose cone"));
  EXPECT_TRUE(soup.names.of(2).empty());
  EXPECT_EQ(read("a.stl", "solid\n" + facet + "\nendsolid\n\x1A").polygons.size(), 1u);
  EXPECT_EQ(read("a.stl", "solid\n" + facet + "\nendsolid\n" + std::string(600, '\0')).polygons.size(), 1u);
  const std::string open = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n";
  EXPECT_THAT(complaint("a.stl", "solid\n" + open + open + "endfacet\nendsolid\n"), HasSubstr("has no 'endfacet'"));
}

TEST(MeshReadLosses, OffCountsOnTheLineOfTheKeyword) {
  for (const char* head : {"OFF3 1 0\n", "OFF 3 1 0\n", "OFF3\n1 0\n"})
    EXPECT_EQ(read("a.off", head + std::string("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).polygons.size(), 1u) << head;
}

TEST(MeshReadLosses, GmshCommentsMayStandFirstAndUnknownSectionsAreTold) {
  const std::string mesh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n"
      "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n";
  const PolygonSoup soup = read("a.msh", "$Comments\nby hand\n$EndComments\n" + mesh + "$elements\n1\n$Endelements\n");
  EXPECT_EQ(soup.polygons.size(), 1u);
  EXPECT_THAT(soup.remarks, ElementsAre(HasSubstr("section $elements on line 17 left out")));
}

/// A square metre, turned by 45 degrees about z, at a place.
std::vector<dvec3> far_plate(const dvec3& place) {
  std::vector<dvec3> points;
  for (const double s : {0.0, std::sqrt(0.5)})
    for (const double z : {0.0, 1.0}) points.push_back(place + dvec3(s, s, z));
  return points;
}

std::vector<dvec3> rounded(std::vector<dvec3> points, double step) {
  for (dvec3& p : points)
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = step > 0.0 ? std::round(p[axis] / step) * step : static_cast<double>(static_cast<float>(p[axis]));
  return points;
}

TEST(MeshReadLosses, StepOfCoordinatesFarFromTheOrigin) {
  const dvec3 utm(500123.4, 5400321.3, 200.0);
  EXPECT_EQ(coordinate_step(rounded(far_plate(utm), 0.0), 0), 0.5);   // single precision, binary
  EXPECT_EQ(coordinate_step(rounded(far_plate(utm), 0.0), 13), 0.5);  // written as text, with six decimals
  EXPECT_NEAR(coordinate_step(rounded(far_plate({2000, 1000, 100}), 0.01), 6), 0.01, 1e-15);
  EXPECT_EQ(coordinate_step(far_plate(utm), 0), 0.0);                              // double precision
  EXPECT_NEAR(coordinate_step(far_plate(utm), 16), 1e-9, 1e-15);                   // and as text
  EXPECT_EQ(coordinate_step(rounded(far_plate({2000, 1000, 100}), 1.0), 0), 0.0);  // round numbers
  EXPECT_EQ(coordinate_step(rounded(far_plate({2000, 1000, 100}), 1.0), 4), 0.0);  // by hand
  std::vector<dvec3> hand_made = rounded(far_plate({2000, 1000, 0}), 1.0);
  hand_made[3].z = 0.1;
  EXPECT_NEAR(coordinate_step(hand_made, 10), 1e-6, 1e-15);  // with six decimals
  const PolygonSoup soup = read("a.obj", "v 1000 2000 100\nv 1000.71 2000.71 100\nv 1000.71 2000.71 101\nf 1 2 3\n");
  EXPECT_EQ(soup.digits, 6);
  EXPECT_NEAR(soup.step.value(), 0.01, 1e-15);
}

TEST(MeshReadLosses, CoarseCoordinatesAreWarnedOfWithTheWavelength) {
  Case c;
  c.sweep.frequencies = {9.4e9, 1e9};
  MeshReport report;
  report.coordinate_step = 0.0078125;
  EXPECT_THAT(reading_sentences(c, report),
              ElementsAre(HasSubstr("steps of 7.81 mm, too coarse for a wavelength of 31.9 mm; move the target close")));
  report.coordinate_step = 3e-4;
  EXPECT_THAT(reading_sentences(c, report), IsEmpty());
}

}  // namespace
}  // namespace raytube::shapes
