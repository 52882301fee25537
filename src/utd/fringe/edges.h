// The edge pass: what the wedges of a target add to physical optics, one look at a time.
#pragma once

#include <span>
#include <vector>

#include "core/field.h"
#include "mesh/features/outlines.h"
#include "mesh/trace/tracer.h"
#include "scene/image.h"
#include "scene/sweep.h"
#include "utd/shadow/edge_visibility.h"
#include "utd/wedge/edge_currents.h"
#include "utd/wedge/transition.h"

namespace raytube {

struct EdgeLookResult {
  // One matrix per frequency; phase reference: centre of the mesh.
  std::vector<ScatteringMatrix> scattering;  // the lit edges' own currents
  std::vector<ScatteringMatrix> higher;      // what these start at other edges; empty at first order
  std::uint64_t wedges_lit = 0;
  bool lit = false;            // any edge radiates
  std::vector<bool> windowed;  // per frequency: the forward-grazing window touched the row
};

/// Far-field amplitude of the fringe currents (Michaeli 1986, first order) on all convex wedges that the transmitter lights,
/// each clipped to its lit part, with `receiver_shadow` also to what the receiver sees, coherently summed in wedge order. Not
/// symmetric in a monostatic look: fringe currents are reciprocal on the Keller cone only.
EdgeLookResult fringe_scattering(std::span<const Wedge> wedges, const Tracer& tracer, const Look& look,
                                 std::span<const double> frequencies, bool receiver_shadow = false);

/// The same with currents that end where their face ends and diffract again at the edge there: `order` edges in a row, 2 or more.
/// Bounded in every direction on polygonal faces, and no edge needs a window there. `tier` says how erfc is evaluated. With
/// `continue_by_images` currents that end at a right-angled fold run on mirrored: right only if what edges send to other faces is
/// painted there, too.
EdgeLookResult fringe_scattering(std::span<const Wedge> wedges, const Outlines& outlines, const Tracer& tracer, const Look& look,
                                 std::span<const double> frequencies, int order, bool receiver_shadow = false,
                                 TransitionTier tier = TransitionTier::exact, bool continue_by_images = false);

/// The same from antennas at a finite distance. Each edge is taken in pieces so short that the waves of both antennas are plane
/// along them; each has its own directions, fields and path, and at order 2 or more its current follows its face as a plane wave
/// would, so that what it starts at an edge x away is late by up to k x^2 / (2 range). Phase reference: the antennas'. `outlines`
/// is not used at order 1.
EdgeLookResult fringe_scattering_near(std::span<const Wedge> wedges, const Outlines& outlines, const Tracer& tracer,
                                      const AntennaPair& antennas, std::span<const double> frequencies, int order,
                                      bool receiver_shadow = false, TransitionTier tier = TransitionTier::exact,
                                      bool continue_by_images = false);

/// The same currents at `frequencies[frequency]`, piece by piece of the lit edges within a cell of the lattice each: those on the
/// faces beside a piece, and what these start at other edges. They add up to the sums above.
std::vector<ImageEdge> fringe_pieces(std::span<const Wedge> wedges, const Outlines& outlines, const Tracer& tracer,
                                     const Look& look, std::span<const double> frequencies, std::size_t frequency, int order,
                                     bool receiver_shadow, TransitionTier tier, bool continue_by_images,
                                     const ImageLattice& lattice);

/// Parts of one edge in a wave that has been reflected before.
struct LitPieces {
  std::uint32_t wedge;
  std::vector<LitInterval> lit;  // in order
  double weight = 1.0;           // 1/2 where the edge lies on the border of the beam
};

/// A reflected plane wave E e^{-jk (s' . r + path)} and what it lights; `look` has its s', E and eta H of a unit wave that was
/// transmitted.
struct ReflectedLook {
  LookVectors look;
  double path = 0.0;  // [m]
  std::vector<LitPieces> pieces;
};

/// The same currents for edges lit by reflected waves, 1 or more in a row; at order 1 they end with their face, too. Edges that
/// are only grazed, and those that do not radiate, add nothing.
EdgeLookResult reflected_fringe_scattering(std::span<const Wedge> wedges, const Outlines& outlines,
                                           std::span<const ReflectedLook> looks, std::span<const double> frequencies, int order,
                                           TransitionTier tier = TransitionTier::exact, bool continue_by_images = true);

}  // namespace raytube
