// What S of a case that moves may be at its times: phasors of paths over places of its bodies.
#pragma once

#include <array>
#include <vector>

#include "case/moving_target.h"

namespace raytube {

/// Keeps a reference to the case.
class PathSamples {
 public:
  PathSamples(const Case& c, const MovingTarget& target);

  std::size_t looks() const { return c_.looks_at_a_time(); }    // of a time, which is a pulse here
  std::size_t kinds() const { return ways_.size() * looks(); }  // of samples: a way from part to part at a look

  /// Of the mean path over the middles of all parts, beyond the way over the origin, which S counts from.
  Complex mean_phasor(std::size_t pulse, std::size_t look, double k) const;

  /// Samples [first, first + count) at the pulses [begin, end), one after the other: phasors of paths, less the mean path, at
  /// every look and any frequency, over ground by way of it or not, times what polarisation makes of them. All have one length.
  std::vector<Complex> columns(std::size_t begin, std::size_t end, std::size_t first, std::size_t count) const;

 private:
  struct Ends {
    Ways ways;
    SphericalBasis transmit, receive;
  };
  struct Stop {
    std::size_t part;
    dvec3 at_rest;
    bool by_ground;  // on the way to it
  };
  struct Sample {
    std::size_t look;
    double k;
    std::vector<Stop> stops;
    bool leaves_by_ground;
    std::array<double, 2> channel;     // angles of the fields from V to H: of the transmitter's, and of the receiver's
    std::array<dvec3, 2> on_the_body;  // along which the first part takes the field up, and the last one gives it
  };

  void find_ways();
  bool ever_near(std::size_t a, std::size_t b) const;
  Sample drawn(std::size_t i) const;
  double path(const Sample& sample, std::size_t pulse) const;
  double polarisation(const Sample& sample, std::size_t pulse) const;

  const Case& c_;
  std::vector<MovingTarget::RigidPart> parts_;
  std::vector<Pose> poses_;         // [pulse][part]
  std::vector<Box> boxes_;          // [pulse][part]
  std::vector<Ends> ends_;          // [pulse][look]
  std::vector<double> mean_paths_;  // [pulse][look], over the middles of all parts [m]
  std::vector<std::vector<std::size_t>> ways_;
};

}  // namespace raytube
