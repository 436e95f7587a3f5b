// How many frames a picture is the mean of, --samples.
#pragma once

#include <optional>

namespace gnomon::settings {

inline constexpr int kUsualSamples = 16;
inline constexpr int kMostSamples = 65535;

/// What was asked for beside --samples that has to do with it.
struct BesideSamples {
    bool overlay = false;
    bool values = false;
    bool statistics = false;
    bool oracle = false;
    bool depth = false;
    bool shadowDepth = false;
    bool reference = false;
    bool sunAngle = false; // asked for, and no point
    bool sky = false;
};

/// As many as `asked` for; else kUsualSamples, but 1 beside options whose figures or colours are those of one frame,
/// and beside --reference, which may have been one. Throws UsageError where several frames are asked for beside the
/// former, or one beside what one frame cannot show.
int samplesOf(const std::optional<int>& asked, const BesideSamples& beside);

} // namespace gnomon::settings
