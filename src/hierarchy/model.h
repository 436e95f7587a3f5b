// What is known of a whole model without reading a page: the page table and the summary.
#pragma once

#include "hierarchy/page.h"
#include "hierarchy/world_frame.h"

#include <map>
#include <string>
#include <vector>

namespace gnomon::hierarchy {

/// Raised whenever the bytes of a .gnm change their meaning; a reader takes those from the oldest on.
/// 2: a vertex of several clusters is stored once a page, and normals take ten bits a number.
/// 3: refinements name their pages by their place among the page's children.
/// 4: errors of attributes, a list of fields, which way is up and the unit; a file of format 3 has none of the first
/// two and the defaults of the others.
constexpr std::uint32_t kFormatVersion = 4;
constexpr std::uint32_t kOldestFormatVersion = 3;

/// The decoded size that a page aims at; a single group larger than this still makes one page.
constexpr std::uint64_t kPageTargetBytes = 256U << 10U;

/// What no writer exceeds and no reader takes: so that what a file claims can be held against it before memory is asked
/// for. A page's decoded bytes (a group is far below), the levels of a model, and the bytes of its summary.
constexpr std::uint64_t kMostPageBytes = 4U << 20U;
constexpr std::uint32_t kMaxLevels = 64;
constexpr std::uint64_t kMostSummaryBytes = 1U << 20U;
constexpr std::uint32_t kMostFieldBits = 16;

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
    double minError = 0; // least and largest of its groups' drawn errors; infinite if it holds a root group
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
    double maxAttributeError = 0; // likewise of their attributes: 0 at level 0
};

/// A value that each vertex carries besides normal and colour, as a number n of `bits` bits:
/// least + n (greatest - least) / (2^bits - 1), so half such a step off at most.
struct Field {
    std::string name;
    double least = 0;
    double greatest = 0;
    std::uint32_t bits = kMostFieldBits; // 1 to kMostFieldBits

    /// The most that a stored value is off by.
    double error() const { return (greatest - least) / (2 * static_cast<double>((1U << bits) - 1U)); }

    bool operator==(const Field&) const = default;
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
    UpAxis up;
    Unit unit = Unit::Metre;
    std::vector<Field> fields; // in the order in which vertices carry them

    /// The largest error of attributes of any cut.
    double attributeError() const {
        double largest = 0;
        for (const LevelInfo& level : levels)
            largest = std::max(largest, level.maxAttributeError);
        return largest;
    }
};

} // namespace gnomon::hierarchy
