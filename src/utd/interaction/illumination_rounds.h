// Edge-diffracted illumination of more pairs of edge and face than a look may take: the strongest of them.
#pragma once

#include <optional>
#include <vector>

#include "utd/interaction/illuminated_faces.h"
#include "utd/interaction/pair_choice.h"

namespace raytube {

struct IlluminationSum {
  std::vector<ScatteringMatrix> scattering;  // per wavenumber [m]
  std::vector<ScatteringMatrix> of_jobs;     // of each job at the wavenumber asked for [m]; empty: none is
  std::vector<ImageEdge> pieces;             // each at the place of its path, if asked for
  ChannelErrors error{};                     // of quadrature [m]
  std::vector<double> squares;               // per wavenumber: sum over what was computed of the largest |S_pq|^2 [m^2]
  double bound_squares = 0.0;                // of the same pairs [m^2]
  std::uint64_t pairs = 0;                   // so many these are
  LeftOut beyond;                            // pairs for which no work was left
  double work = 0.0;                         // counted (utd/wedge/work.h)
};

/// What all illuminations of a look have in common.
struct IlluminationLook {
  const ReceivingFaces& faces;
  const LookVectors& look;
  std::span<const double> wavenumbers;
  double least_error;                    // of each channel, that the error begins with [m]
  std::span<const PathPlace> places{};   // of each job; empty: no pieces are asked for
  std::optional<std::size_t> jobs_at{};  // the wavenumber at which the sum is also kept job by job; none: at none
};

/// Sum over all jobs, each on all faces, with its share `tolerance` of the error.
IlluminationSum illuminate_all(const IlluminationLook& look, std::span<const IlluminationJob> jobs, double tolerance);

/// What a sum over pairs may take.
struct PairBudget {
  double tolerance;  // each job's share of the error [m]
  double pairs;      // that it has work for; none below 1
};

/// Sum over so many of the pairs, which come strongest first, and those that are as strong as the last of them.
IlluminationSum illuminate_strongest(const IlluminationLook& look, std::span<const IlluminationJob> jobs,
                                     std::span<const EdgeFacePair> pairs, const PairBudget& budget);

/// Bytes that one look under way takes at most, for so many frequencies and pairs of an edge and a face.
double illumination_bytes(std::size_t frequencies, double pairs);

}  // namespace raytube
