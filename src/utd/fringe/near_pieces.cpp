#include "utd/fringe/near_pieces.h"

#include <cmath>

namespace raytube {

namespace {

/// What is left of phase off the linear one at the ends of a piece [rad], and the turn of the directions along it [rad].
constexpr double most_bend = 0.1, most_turn = 0.02;

}  // namespace

void PieceCutter::cut(const Wedge& wedge, double begin, double end, std::vector<NearPiece>& pieces) const {
  const auto point = [&](double fraction) { return glm::mix(wedge.start, wedge.end, fraction); };
  const double middle = 0.5 * (begin + end);
  const dvec3 at = point(middle);
  const double path = near_.path_over(at), bend = 0.5 * (near_.path_over(point(begin)) + near_.path_over(point(end))) - path;
  const double half = 0.5 * (end - begin) * wedge.length();
  if (wavenumber_ * std::abs(bend) > most_bend || half > most_turn * near_.nearest(at)) {
    cut(wedge, begin, middle, pieces);
    return cut(wedge, middle, end, pieces);
  }
  const LookVectors look = near_.at(at);
  // The mean of a phase that bends as a parabola is a third of what its ends have.
  pieces.push_back({begin, end, at, look, path + bend / 3.0 + glm::dot(look.scattered - look.incident, at)});
}

}  // namespace raytube
