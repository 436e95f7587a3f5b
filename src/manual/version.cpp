#include "manual/version.h"

#include "hierarchy/model.h"
#include "telemetry/json_text.h"

#include <tbb/version.h>

#include <nlohmann/json.hpp>

namespace gnomon::manual {

std::string versionJson(const std::string& version) {
#ifdef __clang__
    const std::string compiler = "clang " __clang_version__;
#else
    const std::string compiler = "gcc " __VERSION__;
#endif
#ifdef NDEBUG
    const bool isDebug = false;
#else
    const bool isDebug = true;
#endif
#ifdef __SANITIZE_ADDRESS__
    const bool isSanitized = true;
#else
    const bool isSanitized = false;
#endif
    const nlohmann::ordered_json document = {
        {"version", version},
        {"model_formats", nlohmann::ordered_json::array({hierarchy::kOldestFormatVersion, hierarchy::kFormatVersion})},
        {"reads", {"ply", "gltf", "glb", "obj", "stl", "off"}},
        {"writes", {"gnm", "ply", "glb"}},
        {"compiler", compiler},
        {"debug", isDebug},
        {"sanitized", isSanitized},
        {"tbb", TBB_runtime_version()}};
    return telemetry::jsonText(document, 1);
}

} // namespace gnomon::manual
