// The cross-section of a surface beside an edge: how it goes on over facets that are narrower than some distance.
#pragma once

#include "mesh/features/patch_borders.h"
#include "mesh/features/wedges.h"

namespace raytube {

/// The surface from the middle of a wedge onwards over one of its faces, in the plane across the wedge.
struct SurfaceProfile {
  WedgeFace face;        // from the edge to where the profile ends: direction and normal of the chord, patch of the end
  double turn = 0.0;     // of the chord against the wedge's own face, towards the free space [rad]
  int others = 0;        // further convex edges in its first half
  double reached = 1.0;  // of the length; less if it ends at a border, where several surfaces meet, or back where it began
};

/// Follows the surface of a mesh, which must outlive it.
class SurfaceProfiles {
 public:
  /// Creases of less than `min_wedge_angle` [rad] are no edges, nor are its bends.
  SurfaceProfiles(const TriangleMesh& mesh, double min_wedge_angle);

  /// `length` [m] along the surface from the middle of the wedge, starting on faces[side].
  SurfaceProfile find(const Wedge& wedge, int side, double length) const;

 private:
  /// The plane across the wedge, with the axes x_f and n_f of its face and the origin in its middle.
  struct Section {
    Section(const Wedge& wedge, int side);
    double beyond(const dvec3& point) const { return glm::dot(point - middle, along); }
    dvec2 in_plane(const dvec3& vector) const { return {glm::dot(vector, face.into_face), glm::dot(vector, face.normal)}; }

    const WedgeFace& face;
    dvec3 middle, along;
  };
  /// The profile in one triangle. The side over which it leaves begins at corner `exit`.
  struct Step {
    std::uint32_t triangle = no_index;
    int exit = 0;
    dvec2 from, to;
    bool back = false;  // the free space is on the triangle's back
  };

  /// How far the profile has come [m].
  struct PatchLengths {
    double first = 0.0, total = 0.0, in_last = 0.0;  // in the first patch; in all but the last; in the last
    bool on_first = true;

    void leave() {
      if (on_first) first = in_last;
      on_first = false;
      total += in_last;
      in_last = 0.0;
    }
  };

  dvec2 crossing(const Section& section, std::uint32_t triangle, int corner) const;
  std::vector<int> crossed_sides(const Section& section, std::uint32_t triangle) const;
  Step first_step(const Section& section) const;
  Step next_step(const Section& section, const Step& step) const;
  double bend(const Section& section, const Step& from, const Step& to) const;
  bool is_edge(const Section& section, const Step& from, const Step& to) const;
  WedgeFace face_at_end(const Section& section, const Step& last, const dvec2& along) const;
  void end_profile(const Section& section, const Step& last, const dvec2& chord, const PatchLengths& lengths,
                   SurfaceProfile& profile) const;

  const TriangleMesh& mesh_;
  double min_wedge_angle_;
  const EdgeTable& edges_;
  PatchBorders borders_;
};

}  // namespace raytube
