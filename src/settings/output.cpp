#include "settings/output.h"

namespace gnomon::settings {

int samplesOf(const Output& output) {
    const bool isOfOneFrame =
        output.overlay != render::Overlay::None || output.colors.by != ColorBy::None ||
        output.groundTruth != validation::GroundTruth::None ||
        !(output.statistics + output.reference + output.depth + output.shadowClasses + output.shadowDepth).empty();
    return output.samples.value_or(isOfOneFrame ? 1 : kUsualSamples);
}

bool needsMaps(const Output& output) {
    return !output.shadowDepth.empty() || validation::isOfMaps(output.groundTruth) || render::isOfMaps(output.overlay);
}

} // namespace gnomon::settings
