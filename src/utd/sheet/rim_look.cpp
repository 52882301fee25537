#include "utd/sheet/rim_look.h"

namespace raytube {

Received received(const SheetVector& moment, const RimLook& rim, const LookVectors& look, bool electric) {
  Received result;
  for (int p = 0; p < 2; ++p) {
    const dvec3 seen = electric ? look.receive[p] : glm::cross(look.scattered, look.receive[p]);
    result[p] =
        -imaginary_unit / (4 * pi) * (glm::dot(seen, rim.into_face) * moment.across + glm::dot(seen, rim.tangent) * moment.along);
  }
  return result;
}

}  // namespace raytube
