// A tree of waves cut into strips: all of it that no frequency changes. Notation in multiple_diffraction.h.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "utd/multiple/edge_panels.h"
#include "utd/multiple/thin_plate_edge.h"
#include "utd/surface/curved_faces.h"

namespace raytube {

/// What waves of all trees of a look have in common.
struct StripScene {
  std::span<const Wedge> wedges;
  const Outlines& outlines;
  const CurvedFaces* curved;  // those of the wedges' faces that are; null: none
  const LookVectors& look;
  double shortest, longest;  // wavelengths [m]
};

/// S of one face for unit kernels, per receive polarisation: of the current across the edge and of that along it.
struct FaceProjection {
  std::array<double, 2> across, along;
};

/// The face that the strips of a wave run over, as its source and the observer see it.
struct WaveFace {
  Strip strip;
  std::optional<ThinPlateCorrection> thin;  // if it is a side of a thin plate
  FaceProjection projection;
  std::size_t kernels = 0;  // at one wavenumber
  bool as_before;           // whether they are those of the wave before
};

/// Where the numbers of a bundle are: one for each of its points, but a single kernel where its strips are alike.
struct StripRow {
  std::size_t amplitude;  // index of the first where the strips start: of the first strips, or where the bundle before ended
  std::size_t arriving;   // where they end
  std::size_t kernel;     // among those of the wave at one wavenumber
  std::size_t size;       // points
  bool alike;
};

/// The unit incident waves at the first edge, per transmit polarisation.
struct IncidentFields {
  std::array<double, 2> magnetic;  // eta H along the edge
  std::array<double, 2> electric;  // E along the edge
  std::array<double, 2> lying;     // part of E along the edge that the soft current's component along the strips takes
};

/// The pole that semi-infinite strips have in forward grazing, kept finite by a window.
struct ForwardPole {
  SplitKernels kernels;
  double face_width;

  WindowedPole at(double wavenumber) const { return windowed_pole(kernels.angle, wavenumber, face_width); }
};

/// One tree. Filled anew by lay_out, which keeps the buffers.
struct StripLayout {
  WaveTree tree;
  EdgePanels panels;
  std::vector<WaveFace> faces{};  // [wave]
  std::vector<StripRow> rows{};   // [bundle]
  std::size_t arriving = 0;       // amplitudes at the ends of all strips
  IncidentFields incident{};
  std::optional<ForwardPole>
      forward_pole{};          // that of the first wave, if some of its strips are semi-infinite and near that pole
  double fading_length = 0.0;  // electrical length below which strips pass less soft current on

  std::span<const StripRow> rows_of(const TreeWave& wave) const {
    return std::span(rows).subspan(wave.first_bundle, wave.end_bundle - wave.first_bundle);
  }
};

/// The fields of the wave that the incident wave starts on a face.
IncidentFields incident_fields(const StripScene& scene, const StripWave& first);

/// S of a face for unit kernels of a wave.
FaceProjection face_projection(const StripWave& wave, const LookVectors& look);

/// Lays out the strips of the tree, which is that of `wave`, once its points are there.
void lay_out(const StripScene& scene, const StripWave& wave, StripLayout& strips);

}  // namespace raytube
