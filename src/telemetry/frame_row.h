// The measurements of one frame as a row of the log. Each column is declared once and written as CSV and as JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::telemetry {

/// The measurements of one frame, one member per column of the log. Values that were not measured are empty. Times are
/// wall-clock milliseconds, including the wait for the GPU.
struct FrameRow {
    std::string run;
    std::int64_t repetition = 0;
    std::string model;
    std::int64_t frame = 0;
    double timeS = 0; // time on the camera path

    std::string scheme;
    std::string warp;
    std::int64_t zPartitions = 0;
    std::string facePartitions;
    bool stabilize = false;
    std::int64_t filter = 0;
    std::int64_t shadowMaps = 0;      // planned maps
    std::int64_t shadowMapsDrawn = 0; // number of maps without reused and skipped maps
    std::string cullCasters;          // culling of casters: "on", "off" or "receivers"; empty without maps
    std::string shadowTexels;         // WxH, the total size of all maps
    double errorPixels = 1;
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::string backend;

    std::optional<double> planMs;
    std::optional<double> selectMs;
    std::optional<double> cullMs;
    std::optional<double> streamMs;
    std::optional<double> shadowMs;
    std::optional<double> imageMs;
    std::optional<double> totalMs;

    std::optional<std::int64_t> imageTriangles;
    std::optional<std::int64_t> shadowTriangles;
    // Number of shadow map texels that triangles of shadow casters cover, with overdraw. OpenGL does not count them.
    std::optional<std::int64_t> shadowFragments;
    std::optional<std::int64_t> castersTested;
    std::optional<std::int64_t> castersKept;
    std::optional<std::int64_t> drawCalls;
    std::optional<std::int64_t> residentBytes;
    std::optional<std::int64_t> gpuBytes;
    std::optional<std::int64_t> bytesRead;
    std::optional<std::int64_t> pagesMissing;
    std::optional<std::int64_t> pagesDamaged;
    std::optional<double> achievedErrorPixels;

    std::optional<double> near;
    std::optional<double> far;
    std::optional<double> depthRatio;
    std::optional<double> lightAngle; // between view and light, in degrees
    std::optional<double> storageFactor;
    std::optional<double> aliasingBoundX;
    std::optional<double> aliasingBoundZ;
    std::optional<double> measuredAliasing;
    std::optional<bool> isBoundKept;
    std::optional<double> wrongShadowFraction;
    std::optional<double> shadowEdgeP99Px;
    std::optional<double> imageDifference;
    std::optional<double> crawl;

    std::optional<double> sinceStartMs; // from the start of the process to the end of the frame
    // Share of the pixels on surfaces towards the light that miss their shadow because the shadow caster is thinner
    // than a texel. These pixels do not count as wrong.
    std::optional<double> missedShadowFraction;
    // Share of the pixels on surfaces towards the light, with N.L above 0.1, whose shadow is wrong, and which are
    // farther from a true shadow edge than the footprint of a texel.
    std::optional<double> unexplainedShadowFraction;

    // The columns from here on were appended later. They describe shadows and light, and are empty if they do not
    // apply.
    std::string shadows;                        // shadow method: off, maps, exact or rays
    std::optional<std::int64_t> shadowSamples;  // visible points that face the light
    std::optional<std::int64_t> shadowCells;    // number of cells into which the samples are sorted
    std::optional<std::int64_t> sampleTests;    // pairs of a caster's triangle and a sample in the same cell
    std::optional<std::int64_t> exactDecisions; // sample tests that doubles could not resolve
    // Number of pixels whose exact shadow depends on the tolerance or on the rule for ties.
    std::optional<std::int64_t> pixelsWithinTolerance;
    std::optional<std::string> occlusion;
    std::optional<std::int64_t> clustersHidden;
    // Share of all pixels whose lit or dark result differs from the ground truth.
    std::optional<double> wrongPixelsAll;
    std::optional<std::int64_t> imageWidthDrawn;
    std::optional<std::int64_t> samplesPerPixel;
    std::optional<double> sunAngle;
    std::optional<double> lightError;
    // Number of triangles in the image for which edge functions are computed, if occlusion culling skips hidden
    // geometry.
    std::optional<std::int64_t> trianglesSetUp;
    std::optional<std::int64_t> pagesRead; // total since the start
};

/// The value of a log column, or monostate if it was not measured.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

/// One column of the log.
struct Column {
    std::string_view name;
    Value (*value)(const FrameRow& row);
};

/// Returns all columns of the log in their order in the file.
std::span<const Column> columns();

/// Returns the header line of the CSV log, without a line break.
std::string csvHeader();

/// Returns the measurements of a frame as a row of CSV, without a line break. Text with a comma, a quote or a line
/// break is quoted (RFC 4180). Numbers have the shortest form that reads back the same value.
std::string csvRow(const FrameRow& row);

/// Returns the measurements of a frame as a JSON object with all columns. Values that were not measured or are not
/// finite are null.
std::string jsonObject(const FrameRow& row);

} // namespace gnomon::telemetry
