#include "executor/shadow_depth_files.h"

#include <filesystem>

namespace gnomon::executor {

void writeShadowMaps(const std::string& folder, const plan::FramePlan& plan, Executor& executor) {
    const FloatPicture all = executor.shadowDepth();
    for (const plan::ShadowPass& pass : plan.passes) {
        const shadow::Region& region = pass.map.region;
        const shadow::TexelRectangle& r = pass.map.rectangle;
        FloatPicture map(r.width, r.height);
        for (int y = 0; y < r.height; ++y)
            for (int x = 0; x < r.width; ++x)
                map.at(x, r.height - 1 - y) = all.at(r.x + x, r.y + y);
        const std::string name = "slice" + std::to_string(region.slice) + "_" + shadow::name(region.face) + ".pfm";
        writePfm((std::filesystem::path(folder) / name).string(), map);
    }
}

} // namespace gnomon::executor
