// What is logged of one frame: one row, whose columns are declared once and written as CSV and as JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::telemetry {

/// One frame of one run. What was not measured is empty. Times are wall-clock milliseconds around finished work.
struct FrameRow {
    std::string run;
    std::int64_t repetition = 0;
    std::string model;
    std::int64_t frame = 0;
    double timeS = 0; // on the camera path

    std::string scheme;
    std::string warp;
    std::int64_t zPartitions = 0;
    std::string facePartitions;
    bool stabilize = false;
    std::int64_t filter = 0;
    std::int64_t shadowMaps = 0;      // planned
    std::int64_t shadowMapsDrawn = 0; // not reused, not left out
    std::string cullCasters;          // how it was done: "on", "off" or "receivers"; empty without maps
    std::string shadowTexels;         // WxH, a count: all maps together
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
    std::optional<std::int64_t> shadowFragments; // pixels that casters' triangles cover, summed; GL does not count them
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
    std::optional<double> lightAngle; // degrees between view and light
    std::optional<double> storageFactor;
    std::optional<double> promisedAliasingX;
    std::optional<double> promisedAliasingZ;
    std::optional<double> measuredAliasing;
    std::optional<bool> promiseKept;
    std::optional<double> wrongShadowFraction;
    std::optional<double> shadowEdgeP99Px;
    std::optional<double> imageDifference;
    std::optional<double> crawl;

    std::optional<double> sinceStartMs;              // from the start of the process to the end of the frame
    std::optional<double> missedShadowFraction;      // casters under a texel, counted apart from what is wrong
    std::optional<double> unexplainedShadowFraction; // wrong further than a texel's footprint from a true edge

    // Shadows and light, appended to the log; empty where they do not apply.
    std::string shadows;                        // how they are found: off, maps, exact or rays
    std::optional<std::int64_t> shadowSamples;  // visible points that face the light
    std::optional<std::int64_t> shadowCells;    // that they are sorted into
    std::optional<std::int64_t> sampleTests;    // pairs of a caster's triangle and a sample in its cells
    std::optional<std::int64_t> exactDecisions; // of those whose verdict doubles left open
    std::optional<std::int64_t> touchingPixels; // whose verdict hangs on the tolerance, or on the rule for ties
    std::optional<std::string> occlusion;
    std::optional<std::int64_t> clustersHidden;
    std::optional<double> wrongPixelsAll; // share of all pixels lit or dark against the oracle's verdict
    std::optional<std::int64_t> imageWidthDrawn;
    std::optional<std::int64_t> samplesPerPixel;
    std::optional<double> sunAngle;
    std::optional<double> lightError;
    std::optional<std::int64_t> trianglesSetUp; // given edge functions in an image without what is hidden
};

/// The value of a column; nothing if it was not measured.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

/// One column of the log.
struct Column {
    std::string_view name;
    Value (*value)(const FrameRow& row);
};

/// All columns in the order in which they are written.
std::span<const Column> columns();

/// The header line, without a line break.
std::string csvHeader();

/// One row, without a line break. Text with a comma, a quote or a line break is quoted (RFC 4180); numbers are the
/// shortest that read back the same.
std::string csvRow(const FrameRow& row);

/// One JSON object with every column; what was not measured, and what is not finite, is null.
std::string jsonObject(const FrameRow& row);

} // namespace gnomon::telemetry
