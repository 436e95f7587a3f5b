// The view and quality options that render, explain, bench and view share: declared once, in one table.
#pragma once

#include "core/units.h"
#include "hierarchy/model.h"
#include "plan/frame_plan.h"

#include <array>
#include <optional>
#include <span>
#include <string>

namespace gnomon::settings {

/// The most slices that can be asked for: with five faces each, the tree is asked for at most 60 caster volumes at
/// once.
constexpr int kMaxSlices = 12;

/// The settings that a bench sweeps, as they are written. One value each here, lists in a bench.
struct SweptSettings {
    std::string shadows = "maps";
    std::string warp = "auto";
    std::string zPartitions = "4";
    std::string facePartitions = "off";
    std::string stabilize = "off";
    std::string cullCasters = "on";
    std::string shadowTexels = "2048x2048";
    std::string errorPixels = "1";
    std::string filter = "0";

    bool operator==(const SweptSettings&) const = default;
};

/// One of them: its option, the form of its value, its help and its place.
struct SweptOption {
    const char* flag;
    const char* form;
    const char* help;
    std::string SweptSettings::*value;
};

/// All of them, in the order of CONTRACT.md.
std::span<const SweptOption> sweptOptions();

/// An option as the name of a column: "z_partitions" for "--z-partitions".
std::string columnName(const std::string& flag);

/// The options as they are written. Empty text is an option that was not given.
struct ViewOptions {
    std::string size = "800x800";
    std::string cameraFile;
    std::string eye;
    std::string target;
    std::string up;
    std::string fovY;
    std::string near = "auto";
    std::string far = "auto";
    std::string nearFloor;
    std::string light = "0.4,1,0.3";
    std::string maxTriangles;
    std::string splitLambda = "1";
    std::string eta;
    std::string tsmFocus;
    std::string maxAliasing = "4";
    std::string backend = "auto";
    std::string memory = "1G";
    std::string gpuMemory = "1G";
    std::string shaders;
    SweptSettings swept;
    bool isWarpGiven = false; // set by the parser: an explicit --warp
};

/// An option that no bench sweeps.
struct PlainOption {
    const char* flag;
    const char* form;
    const char* help;
    std::string ViewOptions::*value;
};

/// All of those.
std::span<const PlainOption> plainOptions();

/// Those that no bench sweeps and that are not the default, as a shell takes them.
std::string plainOptionsToPaste(const ViewOptions& options);

/// Width and height of the image, in pixels. Throws UsageError where no executor can draw as much.
std::array<int, 2> imageSize(const ViewOptions& options);

/// Whether the options say where the camera is or what it is like.
bool isPosed(const ViewOptions& options);

/// The view that the options ask for; a model of `summary` is framed where no camera is given. Throws UsageError.
plan::View viewOf(const ViewOptions& options, const hierarchy::ModelSummary& summary);

/// The quality that the options ask for with `swept` in place of their own. Throws UsageError, contradictions
/// included.
plan::Quality qualityOf(const ViewOptions& options, const SweptSettings& swept);

/// The camera that shows all of `bounds`, looked at slightly from above.
Camera framingCamera(const Box& bounds, double aspect, const glm::dvec3& up, double fovYRadians);

} // namespace gnomon::settings
