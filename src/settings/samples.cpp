#include "settings/samples.h"

#include "settings/usage_error.h"

#include <array>
#include <string>
#include <utility>

namespace gnomon::settings {

int samplesOf(const std::optional<int>& asked, const BesideSamples& beside) {
    const std::array<std::pair<const char*, bool>, 6> ofOneFrame = {{
        {"--overlay", beside.overlay},
        {"--color-by", beside.values},
        {"--stats", beside.statistics},
        {"--oracle", beside.oracle},
        {"--depth", beside.depth},
        {"--shadow-depth", beside.shadowDepth},
    }};
    bool isOne = beside.reference;
    for (const auto& [option, isGiven] : ofOneFrame) {
        if (!isGiven) continue;
        isOne = true;
        if (asked.value_or(1) > 1)
            throw UsageError{
                "--samples " + std::to_string(*asked) + " and " + option +
                " contradict each other: it is of one frame; --samples 1, or a picture without it"};
    }
    const int samples = asked.value_or(isOne ? 1 : kUsualSamples);
    if (samples == 1 && (beside.sunAngle || beside.sky))
        throw UsageError{
            std::string(beside.sky ? "--sky" : "--sun-angle") +
            " is of pictures that are the mean of several frames, and " +
            (asked ? "--samples 1 asks" : "what is asked beside it calls") + " for one"};
    return samples;
}

} // namespace gnomon::settings
