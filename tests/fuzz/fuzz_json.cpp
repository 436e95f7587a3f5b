// JSON of users: the first byte says whether it is a camera, a path, saved views, a baseline or rows of the theory.
#include "core/error.h"
#include "core/json_file.h"
#include "harness.h"
#include "measure/baseline.h"
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
        static_cast<void>(measure::readBaseline(file));
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
