// ISAR images: S over frequency and one or two angles, brought to the places it comes from.
//
//   I(x) = sum over samples of w S e^{-j K . x} / sum of w,   K = k (s + s')
//
// s, s': directions to transmitter and receiver, K: the wave vector of a sample. A point at x of amplitude A that all looks see
// alike has I(x) = A. Far away K . x is linear in x, and the sum is made by gridding (imaging/fourier.h), exact to 1e-7 of the
// sum of |S| however wide the angle is; at a finite distance it is exact back projection with the paths to every place. (Mensa,
// High Resolution Radar Cross-Section Imaging, 1991, ch. 4; Jakowatz et al., Spotlight-Mode Synthetic Aperture Radar, 1996,
// ch. 2.) Samples of a polar grid count by the volume they stand for in K.
#pragma once

#include "imaging/fourier.h"
#include "imaging/sweep_grid.h"
#include "imaging/window.h"

namespace raytube {

/// What of space an image shows.
struct ImageFrame {
  std::array<double, 3> size{};  // [m] along range, cross-range and the third axis; 0: all that is unambiguous
  dvec3 middle{0.0};             // in the coordinates of the target [m]
};

struct IsarOptions {
  Window window{};  // over frequency and angles
  ImageFrame frame{};
  double pixels = 4.0;  // to a resolution cell of even weights
};

/// What an image shows along one axis.
struct ImageAxis {
  dvec3 direction;     // unit, in the coordinates of the target
  double cell;         // of even weights, from the peak to the first null [m]
  double resolution;   // width of a point's peak 3 dB below its top [m]
  double unambiguous;  // what is farther apart lies upon one another [m]
};

/// The axes of a sweep over frequency and angles: away from the radar in the middle of the angles, along rising azimuth, and,
/// with azimuth and elevation both, upwards, seen from there. With azimuth alone the first two lie in the plane z = 0, whatever
/// theta: what is above it is displaced. Of a scan: away from it, along its lines, and from line to line.
std::vector<ImageAxis> image_axes(const SweepSamples& samples, const AngleGrid& grid, const Window& window);

/// The highest place of an image, between its samples.
struct ImagePeak {
  dvec3 place{0.0};        // in the coordinates of the target [m]
  double amplitude = 0.0;  // of the channel that is largest there [m]
};

/// I over an even grid about a point. `s`: the last axis runs fastest.
struct IsarImage {
  std::vector<ImageAxis> axes;  // two or three
  EvenGrid grid{};
  dvec3 middle{0.0};                  // of the grid, along the axes [m]
  std::vector<ScatteringMatrix> s{};  // [m]
  ImagePeak peak{};

  /// A point of the grid along the axes [m].
  dvec3 coordinates(std::size_t index) const;
  /// In the coordinates of the target [m]; of an image in a plane, on the one through the origin.
  dvec3 place_of(const dvec3& coordinates) const;
  dvec3 place(std::size_t index) const { return place_of(coordinates(index)); }
  double coordinate(std::size_t axis, std::size_t i) const {
    return middle[static_cast<int>(axis)] +
           (static_cast<double>(i) - static_cast<double>(grid.count[axis] / 2)) * grid.step[axis];
  }
};

/// Throws InputError that begins with `what` for an image of more than most_image_cells.
void require_cells(const std::vector<ImageAxis>& axes, const IsarOptions& options, const std::string& what);

/// Throws InputError that begins with `what` for one frequency or one look.
void require_several(const SweepSamples& samples, const std::string& what);

/// Throws the same, and for angles that do not turn the target.
void require_aperture(const SweepSamples& samples, const AngleGrid& grid, const std::string& what);

inline constexpr std::size_t most_image_cells = 4'000'000;

/// S at wave vectors K along the axes of an image [rad/m], and what each counts: of sum 1.
struct ImageSamples {
  std::vector<dvec3> wave_vectors;
  std::vector<double> weights;
  std::vector<ScatteringMatrix> s;

  void add(const dvec3& wave_vector, double weight, const ScatteringMatrix& value);
  /// Makes the sum of the weights 1.
  void normalise();
};

/// The image of samples in the far field. Throws InputError as below.
IsarImage isar_image(const ImageSamples& samples, const std::vector<ImageAxis>& axes, const IsarOptions& options,
                     const std::string& what);

/// Of several frequencies and angles. Throws InputError that begins with `what` for more than most_image_cells.
IsarImage isar_image(const SweepSamples& samples, const AngleGrid& grid, const IsarOptions& options, const std::string& what);

}  // namespace raytube
