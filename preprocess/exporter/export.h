// `gnomon export`: one uniform cut of a model as a PLY.
#pragma once

#include "core/progress.h"

#include <cstdint>
#include <optional>
#include <string>

namespace gnomon::exporter {

/// What to cut at: exactly one of both.
struct ExportLimit {
    std::optional<std::uint64_t> triangles; // at most
    std::optional<double> error;            // at most, world units
};

struct ExportedCut {
    double error = 0; // the largest stored error in it, world units
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
};

/// Writes the finest uniform cut of `model` with at most `limit.triangles`, or the coarsest whose error is at most
/// `limit.error`, to the binary PLY `output`. Corners with the same position, normal, colour and fields are one vertex;
/// positions are floats where all of them fit, else doubles; so are the values of a field. Holds the cut in memory.
/// Throws Error if no cut is that small or that exact, or a page is damaged.
ExportedCut exportCut(
    const std::string& model, const ExportLimit& limit, const std::string& output, Progress& progress);

} // namespace gnomon::exporter
