// A small, valid hierarchy of several levels made in code, so that whatever reads models can be tested without a build.
#pragma once

#include "hierarchy/model.h"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::tests {

/// What a tiny model is made of.
struct TinyModelOptions {
    unsigned gridExponent = 5; // a height field of (2^n + 1)^2 vertices, 2 * 4^n triangles, edges one world unit long
    double height = 3;         // world units, of the largest hill
    std::uint64_t seed = 1;
    std::uint32_t clusterTriangles = 128;
    std::uint32_t groupClusters = 4;
    std::uint32_t pageGroups = 2;
    bool normals = false;
    bool colors = false;
    double attributeErrorFrom = -1; // errors e above this have errors of attributes above e, others below; if not < 0
    glm::dvec3 origin{0};
};

/// A model as it would be decoded; `pages` in file order, so that a test can damage it before it is written.
struct TinyModel {
    hierarchy::ModelSummary summary;
    std::vector<hierarchy::Page> pages;
};

/// A height field over (x, z), y up, cut into clusters, grouped and decimated level by level with locked group borders
/// until one group is left. Errors are exact bounds of the vertical deviation, bounds nest.
TinyModel makeTinyModel(const TinyModelOptions& options);

/// Writes `model` to `path`; returns its content hash.
std::string writeModel(const TinyModel& model, const std::string& path);

} // namespace gnomon::tests
