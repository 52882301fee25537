#include "utd/shadow/clear_between.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "mesh/model/triangle_pairs.h"

namespace raytube {

namespace {

// Heights of points over a plane.
struct Heights {
  double least = std::numeric_limits<double>::infinity(), most = -least;

  template <class Points>
  Heights(const Patch& plane, const Points& points) {
    for (const dvec3& point : points) {
      const double height = plane.height(point);
      least = std::min(least, height), most = std::max(most, height);
    }
  }
};

class Between {
 public:
  Between(const FaceTree& faces, const Wedge& one, const Wedge& other)
      : faces_(faces),
        ends_{one.start, one.end, other.start, other.end},
        // Points and offsets of planes carry a few roundings of numbers up to the radius each (ExactHit).
        rounding_(8.0 * std::numeric_limits<double>::epsilon() * faces.mesh().radius) {
    for (const Wedge* wedge : {&one, &other})
      for (const std::uint32_t patch : {wedge->faces[0].patch, wedge->faces[1].patch, wedge->border_patch})
        if (patch != no_index && std::ranges::find(own_, patch) == own_.end()) own_.push_back(patch);
  }

  bool is_clear() const {
    Box box;
    for (const dvec3& end : ends_) box.add(end);
    std::vector<std::uint32_t> near;
    collect_within(faces_, box, near);
    return std::ranges::none_of(near, [&](std::uint32_t face) { return may_block(face); });
  }

 private:
  bool may_block(std::uint32_t face) const {
    const std::uint32_t patch = faces_.faces()[face].patch;
    if (std::ranges::find(own_, patch) != own_.end() || is_parted(face, patch)) return false;
    return std::ranges::none_of(own_, [&](std::uint32_t own) { return is_parted(face, own); });
  }

  // By the plane of a patch, in which not both edges lie: rays reach it at one of their ends at most.
  bool is_parted(std::uint32_t face, std::uint32_t patch) const {
    const Patch& plane = faces_.mesh().patches[patch];
    const Heights of_face(plane, faces_.points(face)), of_ends(plane, ends_);
    return (of_ends.least >= -rounding_ && of_ends.most > rounding_ && of_face.most <= rounding_) ||
           (of_ends.most <= rounding_ && of_ends.least < -rounding_ && of_face.least >= -rounding_);
  }

  const FaceTree& faces_;
  std::array<dvec3, 4> ends_;
  double rounding_;
  std::vector<std::uint32_t> own_;
};

}  // namespace

bool is_clear_between(const FaceTree& faces, const Wedge& one, const Wedge& other) {
  return Between(faces, one, other).is_clear();
}

}  // namespace raytube
