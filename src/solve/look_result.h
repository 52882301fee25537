// What one look gives, and the same as bytes, to be kept and taken up again.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sbr/beams/tube_sums.h"
#include "utd/fringe/edge_look_result.h"
#include "utd/interaction/edge_face_interaction.h"
#include "utd/surface/surface_waves.h"

namespace raytube {

/// One look, all frequencies: what the tubes and the wedges give, kept apart.
struct LookResult {
  TubeSums tubes;
  EdgeLookResult edges;
  InteractionResult interaction;
  SurfaceWaveResult surface;

  /// Lets go of what the estimate of the tubes' error was made from, which is most of it at many frequencies.
  void keep_sums_only();
};

/// Exactly what the rows and the counts of a sweep need, every double with all its bits. Of the same program only.
std::string look_bytes(const LookResult& look);

/// The look again, or none if the bytes are not those of one at so many frequencies.
std::optional<LookResult> look_of_bytes(std::string_view bytes, std::size_t frequencies);

}  // namespace raytube
