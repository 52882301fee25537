// Which edges of solids run between two corners of three faces.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "mesh/features/wedges.h"
#include "utd/corner/solid_corner.h"

namespace raytube {

/// All corners of one shape, solved when a look first asks. Thread-safe.
class SolidCorners {
 public:
  explicit SolidCorners(const SolidCornerShape& shape) : shape_(shape) {}
  const SolidCornerShape& shape() const { return shape_; }
  const SolidCorner& solved() const;

 private:
  SolidCornerShape shape_;
  mutable std::once_flag once_;
  mutable std::optional<SolidCorner> corner_;
};

/// One end of an edge, with the frame of SolidCorner.
struct SolidEnd {
  dvec3 position;
  // Away from the corner: this edge, and those beside it, the one closer to it first; of two as close the one with which they are
  // right-handed.
  std::array<dvec3, 3> edges;
  std::array<double, 2> other_lengths;  // lengths of the two edges beside this one [m]
  std::array<std::uint32_t, 2> beside;  // wedges of those two
  std::array<dvec3, 3> frame;
  const SolidCorners* corners = nullptr;

  /// Components of a direction or a field in that frame.
  dvec3 local(const dvec3& v) const { return {glm::dot(v, frame[0]), glm::dot(v, frame[1]), glm::dot(v, frame[2])}; }
  /// Whether one of the corner's faces faces that direction.
  bool sees(const dvec3& towards) const;
  /// 1, 0 where one of the corner's edges diffracts a wave along another one, and where its edges point.
  double weight(const dvec3& towards, double wavenumber, double length) const;

  /// Of a wave of either polarisation from there, at any wavelength, or by reciprocity of one that goes there.
  struct Passage {
    std::array<Complex, 2> wave;
    const std::array<Complex, 2>& at(double /*electrical_length*/) const { return wave; }
  };
  Passage passage(const dvec3& towards, const std::array<dvec3, 2>& fields) const;
};

struct SolidEdge {
  std::array<SolidEnd, 2> ends;
  double length;
  double n;  // exterior angle / pi
  static constexpr double thickness = 0.0;
  static constexpr dvec3 outwards{0.0};

  /// 1 up to 20 wavelengths, none from 40 on, where the wave is a few hundredths of what its corners scatter.
  double length_weight(double wavenumber) const;
};

/// The edges of conducting solids that end, at both ends, where three edges meet and nothing else, each 45 to 165 degrees
/// off a plane; null for others. The shapes of corners are rounded to 0.1 degrees.
class SolidEdges {
 public:
  /// On a body with more than `most_shapes` only the corners of the longest edges have waves, on one with more than `most_edges`
  /// edges none. What other bodies there are does not count.
  explicit SolidEdges(std::span<const Wedge> wedges);

  const SolidEdge* operator[](std::uint32_t wedge) const { return edges_[wedge].get(); }
  /// The memory of the corners, once they are solved.
  std::size_t bytes() const { return shapes_.size() * SolidCorner::bytes(); }

  static constexpr std::size_t most_shapes = 12, most_edges = 64;

 private:
  class Finder;
  using Shapes = std::vector<const SolidCorners*>;
  /// False if one of them would be one more shape than the body may have.
  bool find_corners(SolidEdge& edge, Shapes& of_body);

  std::vector<std::unique_ptr<SolidCorners>> shapes_;
  std::vector<std::unique_ptr<SolidEdge>> edges_;  // [wedge]
};

}  // namespace raytube
