// Where light comes from or goes to.
#pragma once

#include "core/field.h"

namespace raytube {

/// What rays from an edge go to: a direction, or a point in front of the target.
class Viewpoint {
 public:
  Viewpoint(const dvec3& direction) : vector_(direction) {}
  static Viewpoint at(const dvec3& position) {
    Viewpoint view(position);
    view.far_ = false;
    return view;
  }

  /// Unit vector towards it.
  dvec3 from(const dvec3& point) const { return far_ ? vector_ : glm::normalize(vector_ - point); }
  /// The direction towards the viewpoint, not of unit length but linear in `point`.
  dvec3 towards_from(const dvec3& point) const { return far_ ? vector_ : vector_ - point; }
  bool far() const { return far_; }

 private:
  dvec3 vector_;
  bool far_ = true;
};

}  // namespace raytube
