// The number of frames that are averaged for a picture (--samples).
#pragma once

#include <optional>

namespace gnomon::settings {

inline constexpr int kUsualSamples = 16;
inline constexpr int kMostSamples = 65535;

/// The other options of the command that restrict the number of frames. True: the option is given.
struct BesideSamples {
    bool overlay = false;
    bool values = false;
    bool statistics = false;
    bool oracle = false;
    bool depth = false;
    bool shadowDepth = false;
    bool reference = false;
    bool sunAngle = false; // with an angle above 0
    bool sky = false;
};

/// Returns the number of frames for a picture: `asked`, or a default. The default is kUsualSamples. It is 1 with
/// options whose values or colours describe one frame, and with --reference, because the reference may be one frame.
/// Throws UsageError if several frames are requested with an option that describes one frame, or if one frame has to
/// show penumbrae or the sky.
int samplesOf(const std::optional<int>& asked, const BesideSamples& beside);

} // namespace gnomon::settings
