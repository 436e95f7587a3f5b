// JSON of users: the first byte says whether it is a camera, a path, saved views, a baseline or rows of the theory.
#include "bench/alike_keys.h"
#include "bench/result_formats.h"
#include "bench/result_json.h"
#include "bench/verdict_text.h"
#include "core/error.h"
#include "core/json_file.h"
#include "harness.h"
#include "path/camera_path.h"
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

/// Compares the file with a bench whose first run is twice as slow, and whose second run lacks a page.
void compareWith(const bench::ResultSet& before) {
    bench::ResultSet now = before;
    for (std::size_t i = 0; i < now.runs.size(); ++i) {
        if (i == 1) now.runs[i].pagesMissing = 1;
        if (i != 0) continue;
        for (auto& repetition : now.runs[i].realMs)
            for (double& time : repetition)
                time *= 2;
    }
    bench::Limits limits;
    limits.alikeKeys = bench::alikeKeys(before, now.context, false);
    bench::Verdict verdict = bench::judge(before, now, limits);
    const std::vector<bench::Gate> context = bench::contextGates(before, now.context, limits);
    verdict.gates.insert(verdict.gates.end(), context.begin(), context.end());
    static_cast<void>(bench::verdictText(verdict) + bench::failureLine(verdict) + bench::verdictJson(verdict));
    static_cast<void>(bench::resultJson(now) + bench::summaryMarkdown(now, &verdict));
    static_cast<void>(bench::bmfJson(now) + bench::actionJson(now));
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
        compareWith(bench::readResultSet(file));
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
