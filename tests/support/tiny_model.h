// A small, valid hierarchy with several levels, made in code. Tests of model readers need no build.
#pragma once

#include "hierarchy/model.h"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::tests {

/// The parameters of a tiny model.
struct TinyModelOptions {
    unsigned gridExponent = 5; // height field with (2^n + 1)^2 vertices, 2 * 4^n triangles and edges of one world unit
    double height = 3;         // of the highest hill, in world units
    std::uint64_t seed = 1;
    std::uint32_t clusterTriangles = 128;
    std::uint32_t groupClusters = 4;
    std::uint32_t pageGroups = 2;
    bool normals = false;
    bool colors = false;
    // If not negative, groups with an error e above this value have an attribute error above e, and all others below e.
    double attributeErrorFrom = -1;
    glm::dvec3 origin{0};
};

/// A model in decoded form, with `pages` in file order, so that a test can damage it before writing.
struct TinyModel {
    hierarchy::ModelSummary summary;
    std::vector<hierarchy::Page> pages;
};

/// Makes a height field over (x, z) with y up. It is divided into clusters, grouped, and simplified level by level with
/// locked group borders until one group remains. Errors are exact bounds of the vertical distance, and bounds nest.
TinyModel makeTinyModel(const TinyModelOptions& options);

/// Writes `model` to `path` and returns its content hash.
std::string writeModel(const TinyModel& model, const std::string& path);

} // namespace gnomon::tests
