// Weights of samples in frequency or angle: they lower the side lobes of a point and widen its peak.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace raytube {

enum class WindowKind { rectangular, hann, hamming, taylor, kaiser };

/// A window and what it is made with.
struct Window {
  WindowKind kind = WindowKind::taylor;
  double sidelobe_db = 35.0;  // taylor, kaiser: side lobes this far below the peak [dB]
};

/// Side lobes that taylor and kaiser can be asked for [dB].
inline constexpr double least_sidelobe_db = 15.0, most_sidelobe_db = 100.0;

/// "rectangular", "hann", "hamming", "taylor", "kaiser"; none for another name.
std::optional<WindowKind> window_of_name(const std::string& name);
std::string name_of(const Window& window);

/// Its name, and how low its side lobes are where they are chosen: "taylor, 35 dB".
std::string description_of(const Window& window);

/// Weights of `count` samples in even steps, symmetric, the largest 1; of one sample 1.
/// hann, hamming: Harris, Proc. IEEE 66 (1978), eqs. 27a, 30b, at the middles of the samples' steps. taylor: Taylor, IRE Trans.
/// AP-3 (1955), eqs. 33, 41, with as many equal lobes as keep the weights falling to the ends. kaiser: Kaiser & Schafer, IEEE
/// Trans. ASSP-28 (1980), eqs. 3, 4b.
std::vector<double> weights(const Window& window, std::size_t count);

/// Width of a point's peak 3 dB below its top, in units of what even weights have between the peak and the first null: 0.886 for
/// those.
double peak_width(const std::vector<double>& weights);

}  // namespace raytube
