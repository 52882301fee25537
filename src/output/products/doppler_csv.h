// Range-Doppler maps and spectrograms as tables.
#pragma once

#include <filesystem>

#include "imaging/doppler.h"

namespace raytube {

/// doppler.csv: one row per look of a pulse, range, velocity and, with an array, cosine, the last one fastest: complex amplitude
/// and sigma of the four channels. Of one frequency there are no ranges.
void write_doppler_csv(const std::filesystem::path& file, const DopplerMap& map, const Window& window);

/// spectrogram.csv: one row per look of a pulse, time and velocity, the velocity fastest: sigma of the four channels.
void write_spectrogram_csv(const std::filesystem::path& file, const Spectrogram& spectrogram, const Window& window);

}  // namespace raytube
