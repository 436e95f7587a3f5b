#include "render/shadow_maps.h"

#include <utility>

namespace gnomon::render {

std::vector<NamedDepths> shadowMaps(const plan::FramePlan& plan, Backend& backend) {
    std::vector<NamedDepths> maps;
    const FloatPicture all = backend.shadowDepth();
    for (const plan::ShadowPass& pass : plan.passes) {
        const shadow::Region& region = pass.map.region;
        const shadow::TexelRectangle& r = pass.map.rectangle;
        FloatPicture map(r.width, r.height);
        for (int y = 0; y < r.height; ++y)
            for (int x = 0; x < r.width; ++x)
                map.at(x, r.height - 1 - y) = all.at(r.x + x, r.y + y);
        const std::string name = "slice" + std::to_string(region.slice) + "_" + shadow::name(region.face) + ".pfm";
        maps.push_back({name, std::move(map)});
    }
    return maps;
}

} // namespace gnomon::render
