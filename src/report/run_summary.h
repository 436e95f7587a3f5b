// One run of a benchmark as the report sees it: its settings, what it cost and how wrong it was.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::report {

/// The ways in which a run can be wrong; each run knows some of them.
enum class ErrorKind {
    WrongPixels,      // the fraction of all pixels that are lit where integers have them dark, or the other way round
    PromisedAliasing, // the larger of the promised perspective aliasing in x and z over [near, far]
    MeasuredAliasing, // the perspective aliasing found at the pixels
    WrongShadow,      // the fraction of lit-side pixels whose shadow differs from rays', missed thin casters too
    ShadowEdge,       // 99th percentile of the distance of shadow edges from ray-traced ones, pixels
    ImageDifference,  // mean absolute difference from full detail in ray-traced shadows, fraction of full scale
};

inline constexpr std::array kErrorKinds{
    ErrorKind::WrongPixels,
    ErrorKind::PromisedAliasing,
    ErrorKind::MeasuredAliasing,
    ErrorKind::WrongShadow,
    ErrorKind::ShadowEdge,
    ErrorKind::ImageDifference};

/// The column of the bench log that holds `kind`, or a short name of the two that do.
std::string_view key(ErrorKind kind);

/// What a person calls `kind`, with its unit.
std::string_view label(ErrorKind kind);

/// The median times of a frame's stages, milliseconds.
struct StageTimes {
    double plan = 0;
    double select = 0;
    double cull = 0;
    double stream = 0;
    double shadow = 0;
    double image = 0;
};

/// The frames of one run, over all repetitions.
struct RunSummary {
    std::string name;                            // unique in a report
    std::string options;                         // to paste behind `gnomon render MODEL`
    std::map<std::string, std::string> settings; // the swept columns and their values
    std::string scheme; // "map+w", "zp4": how maps are laid out, or the cells of exact shadows; empty without either
    int shadowMaps = 0;
    double p50Ms = 0; // of the whole frame
    double p95Ms = 0;
    double p99Ms = 0;
    std::optional<double> noise; // half the range of the repetitions' medians over their middle; needs two of them
    StageTimes stages;
    double imageTriangles = 0;
    double shadowTriangles = 0;
    std::map<ErrorKind, double> errors; // over the frames the largest aliasing, the median edge distance, else the mean
    double crawl = -1;                  // share of fixed points whose shadow test changed; below 0: not measured
    double storageFactor = 0;
    bool promiseKept = true;
    std::uint64_t pagesDamaged = 0; // by the last frame
    std::uint64_t pagesMissing = 0; // in the frame that lacked most
    std::vector<double> frameMs;    // along the path, the median over repetitions
};

} // namespace gnomon::report
