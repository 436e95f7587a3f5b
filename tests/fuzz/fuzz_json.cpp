// JSON of users: the first byte says whether it is a camera, a path, saved views, a baseline or rows of the theory.
#include "bench/baseline.h"
#include "core/error.h"
#include "core/json_file.h"
#include "harness.h"
#include "path/camera_path.h"
#include "settings/table.h"
#include "theory/rows.h"

#include <cmath>
#include <cstdlib>

namespace gnomon::fuzz {
namespace {

void readPath(const std::string& file) {
    const path::CameraPath walk = path::readCameraPath(file);
    for (int frame = 0; frame < 5; ++frame)
        static_cast<void>(path::cameraAt(walk, path::frameTime(walk, frame, 5)));
    static_cast<void>(path::contentHash(walk));
    static_cast<void>(path::toJson(walk));
}

/// Holds a bench that drew the runs of the baseline, the first of them twice as slow, one with a page missing, against
/// it.
void compareWith(const bench::Baseline& baseline) {
    std::vector<report::RunSummary> runs;
    for (const auto& [name, p50Ms] : baseline.p50Ms) {
        report::RunSummary& run = runs.emplace_back();
        run.name = name;
        run.p50Ms = runs.size() == 1 ? 2 * p50Ms : p50Ms;
        run.pagesMissing = runs.size() == 2 ? 1 : 0;
    }
    static_cast<void>(bench::notCompared(baseline, runs));
    const auto attempt = [](const auto& compare) {
        try {
            compare();
        } catch (const Error&) { // refused in words
        }
    };
    attempt([&] { bench::requireComplete(baseline, runs, true); });
    if (!runs.empty()) attempt([&] { bench::requireNotSlower(baseline, runs, 10); });
    std::map<std::string, std::string> now = baseline.context;
    for (const char* key : {"model_content_hash", "path_content_hash", "frames", "real_time", "backend", "threads"})
        now.try_emplace(key, "not given");
    for (const settings::Setting& setting : settings::table())
        if (!setting.description().statedAs.empty())
            now.try_emplace(std::string(setting.description().statedAs), "not given");
    attempt([&] { bench::requireComparable(baseline, now); });
}

void readAs(unsigned kind, const std::string& file) {
    switch (kind) {
    case 0:
        static_cast<void>(path::toJson(path::readCamera(file)));
        break;
    case 1:
        readPath(file);
        break;
    case 2:
        static_cast<void>(path::toJson(path::readViews(file)));
        break;
    case 3:
        compareWith(bench::readBaseline(file));
        break;
    default:
        static_cast<void>(theory::evaluateRows(readJsonFile(file), file));
        break;
    }
}

} // namespace
} // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static gnomon::fuzz::InputFile file(".json");
    if (size < 1) return 0;
    try {
        gnomon::fuzz::readAs(data[0] % 5U, file.with({data + 1, size - 1}));
    } catch (const gnomon::Error&) { // refused in words
    }
    return 0;
}
