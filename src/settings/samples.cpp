#include "settings/samples.h"

#include "settings/usage_error.h"

#include <array>
#include <string>
#include <utility>

namespace gnomon::settings {

int samplesOf(const std::optional<int>& asked, const BesideSamples& beside) {
    const std::array<std::pair<const char*, bool>, 5> ofOneFrame = {{
        {"--overlay", beside.overlay},
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
    return asked.value_or(isOne ? 1 : kUsualSamples);
}

} // namespace gnomon::settings
