#include "render/backend.h"

#include "core/error.h"

namespace gnomon::render {

DrawStatistics Backend::draw(const DrawInputs& frame) {
    DrawStatistics statistics;
    statistics.shadows = drawShadowMaps(frame);
    statistics.image = drawImage(frame);
    statistics.deviceMemory = deviceMemory();
    return statistics;
}

DrawStatistics Backend::drawExactly(const DrawInputs&) {
    throw Error("exact shadows", "this backend does not support them", "the software backend", name());
}

} // namespace gnomon::render
