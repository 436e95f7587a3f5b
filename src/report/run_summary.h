// The summary of one run of a bench: settings, cost and errors.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::report {

/// The kinds of errors of a run. Each run has some of them.
enum class ErrorKind {
    WrongPixels,      // share of all pixels whose lit or dark result differs from integer arithmetic
    AliasingBound,    // larger bound of perspective aliasing of x and z over [near, far]
    MeasuredAliasing, // perspective aliasing measured at the pixels
    WrongShadow,      // share of lit-side pixels whose shadow differs from ray tracing, including missed thin casters
    ShadowEdge,       // 99th percentile of the distance of shadow edges from ray-traced edges, in pixels
    ImageDifference,  // mean absolute difference from full detail in ray-traced shadows, as a fraction of full scale
};

inline constexpr std::array kErrorKinds{
    ErrorKind::WrongPixels,
    ErrorKind::AliasingBound,
    ErrorKind::MeasuredAliasing,
    ErrorKind::WrongShadow,
    ErrorKind::ShadowEdge,
    ErrorKind::ImageDifference};

/// Returns the column of the bench log with `kind`, or a short name if two columns form it.
std::string_view key(ErrorKind kind);

/// Returns a readable name of `kind`, with its unit.
std::string_view label(ErrorKind kind);

/// The median times of a frame's stages, in milliseconds.
struct StageTimes {
    double plan = 0;
    double select = 0;
    double cull = 0;
    double stream = 0;
    double shadow = 0;
    double image = 0;
};

/// The smallest and the largest of some values.
struct Range {
    double low = 0;
    double high = 0;
};

/// The frames of one run, over all repetitions.
struct RunSummary {
    std::string name;                            // unique in a report
    std::string options;                         // options for `gnomon render MODEL`
    std::map<std::string, std::string> settings; // the swept columns and their values
    // "map+w", "zp4": the scheme of the maps, or of the sample grid of exact shadows; empty without either
    std::string scheme;
    int shadowMaps = 0;
    double p50Ms = 0; // of the whole frame
    double p95Ms = 0;
    double p99Ms = 0;
    // Half the range of the repetitions' medians, relative to the middle. It requires two repetitions.
    std::optional<double> noise;
    StageTimes stages;
    // The same medians per repetition: the smallest and the largest. They equal `stages` for a single repetition.
    StageTimes minStages;
    StageTimes maxStages;
    double imageTriangles = 0;
    double shadowTriangles = 0;
    // Over all frames: max of the aliasing, median of the edge distance, mean of all other errors.
    std::map<ErrorKind, double> errors;
    std::map<ErrorKind, Range> errorRanges; // over the frames that were compared with a ground truth
    double crawl = -1;                      // share of fixed points whose shadow changed; negative: not measured
    double storageFactor = 0;
    bool isBoundKept = true;
    std::uint64_t pagesDamaged = 0; // total up to the last frame
    std::uint64_t pagesMissing = 0; // max over all frames
    std::vector<double> frameMs;    // along the path, median over repetitions
    std::vector<Range> frameRanges; // along the path, over the repetitions; empty for a single repetition
};

} // namespace gnomon::report
