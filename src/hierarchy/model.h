// What is known of a whole model without reading a page: the page table and the summary.
#pragma once

#include "hierarchy/page.h"

#include <map>
#include <string>
#include <vector>

namespace gnomon::hierarchy {

/// Raised whenever the bytes of a .gnm change their meaning; a reader takes exactly this one.
/// 2: a vertex of several clusters is stored once a page, and normals take ten bits a number.
/// 3: refinements name their pages by their place among the page's children.
constexpr std::uint32_t kFormatVersion = 3;

/// The decoded size that a page aims at; a single group larger than this still makes one page.
constexpr std::uint64_t kPageTargetBytes = 256U << 10U;

/// What no writer exceeds and no reader takes: so that what a file claims can be held against it before memory is asked
/// for. A page's decoded bytes (a group is far below), the levels of a model, and the bytes of its summary.
constexpr std::uint64_t kMostPageBytes = 4U << 20U;
constexpr std::uint32_t kMaxLevels = 64;
constexpr std::uint64_t kMostSummaryBytes = 1U << 20U;

/// What the tables of a model may take while it opens where nobody says how much, in bytes: those of 1.8 million pages,
/// a mesh of over ten billion triangles.
constexpr std::uint64_t kMostTableBytes = std::uint64_t{512} << 20U;

/// One row of the page table: all that stays resident.
struct PageInfo {
    std::uint64_t offset = 0; // in the file
    std::uint32_t storedBytes = 0;
    std::uint64_t checksum = 0; // xxh3-64 of the stored bytes
    std::uint32_t level = 0;
    std::uint32_t groupCount = 0;
    std::uint32_t clusterCount = 0;
    std::uint32_t refinementCount = 0;
    std::uint32_t vertexCount = 0;
    std::uint32_t triangleCount = 0;
    GridBox box;         // of its vertices
    Sphere bounds;       // encloses the bounds of its groups; local space
    double minError = 0; // least and largest of its groups' errors; infinite if it holds a root group
    double maxError = 0;
    std::vector<std::uint32_t> children; // the pages that its refinements name, each once, ascending
};

/// The bytes that the page of a row takes when decoded.
constexpr std::uint64_t decodedPageBytes(const PageInfo& info) {
    return sizeof(Page) + std::uint64_t{info.groupCount} * sizeof(Group) +
           std::uint64_t{info.clusterCount} * sizeof(Cluster) +
           std::uint64_t{info.refinementCount} * sizeof(Refinement) + std::uint64_t{info.vertexCount} * sizeof(Vertex) +
           std::uint64_t{info.triangleCount} * sizeof(Triangle);
}

struct LevelInfo {
    std::uint64_t triangles = 0;
    std::uint64_t clusters = 0;
    std::uint64_t groups = 0;
    double maxError = 0; // the largest stored error of the clusters of this level: snap error at level 0; finite
};

/// What `gnomon info` prints.
struct ModelSummary {
    Grid grid;
    Box bounds; // of the snapped source, world space
    std::uint64_t sourceTriangles = 0;
    std::uint64_t sourceVertices = 0;
    std::map<std::string, std::uint64_t> dropped; // reason -> source triangles
    std::uint64_t coarsestTriangles = 0;          // of all clusters without a parent
    bool hasNormals = false;
    bool hasColors = false;
    std::vector<LevelInfo> levels;              // finest first
    std::map<std::string, std::string> options; // those of the build that change bytes
};

} // namespace gnomon::hierarchy
