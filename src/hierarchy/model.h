// The data of a model that are read when it is opened, before its pages: the page table and the summary.
#pragma once

#include "hierarchy/page.h"
#include "hierarchy/world_frame.h"

#include <map>
#include <string>
#include <vector>

namespace gnomon::hierarchy {

/// The version of the .gnm format. It increases when the bytes change their meaning. A reader accepts all versions
/// since kOldestFormatVersion.
/// - 2: a vertex of several clusters is stored once per page; a component of a normal has ten bits.
/// - 3: refinements name a page by its index among the children of their own page.
/// - 4: attribute errors, a list of fields, the up direction and the unit. A file of format 3 has no attribute errors
///   and no fields, and the default up direction and unit.
constexpr std::uint32_t kFormatVersion = 4;
constexpr std::uint32_t kOldestFormatVersion = 3;

/// The target size of a decoded page in bytes. A group of clusters that is larger becomes a page of its own.
constexpr std::uint64_t kPageTargetBytes = 256U << 10U;

/// Limits that each writer of model files respects and each reader checks before it allocates memory. They are the
/// decoded bytes of a page (a group is much smaller), the number of levels of a model, and the bytes of its summary.
constexpr std::uint64_t kMaxPageBytes = 4U << 20U;
constexpr std::uint32_t kMaxLevels = 64;
constexpr std::uint64_t kMaxSummaryBytes = 1U << 20U;
constexpr std::uint32_t kMaxFieldBits = 16;

/// The default limit of the memory, in bytes, for the tables of a model while it is opened. It is sufficient for 1.8
/// million pages, which is a mesh of more than ten billion triangles.
constexpr std::uint64_t kMaxTableBytes = std::uint64_t{512} << 20U;

/// A row of the page table, which describes one page. The rows of all pages stay in memory.
struct PageInfo {
    std::uint64_t offset = 0; // bytes from the start of the file
    std::uint32_t storedBytes = 0;
    std::uint64_t checksum = 0; // xxh3-64 of the stored bytes
    std::uint32_t level = 0;
    std::uint32_t groupCount = 0;
    std::uint32_t clusterCount = 0;
    std::uint32_t refinementCount = 0;
    std::uint32_t vertexCount = 0;
    std::uint32_t triangleCount = 0;
    GridBox box;         // bounding box of the vertices
    Sphere bounds;       // encloses the bounds of the groups; local space
    double minError = 0; // min and max drawn error of its groups; the max is infinite if the page contains a root group
    double maxError = 0;
    // ids of the pages with the finer groups from which clusters of this page were simplified; ascending, without
    // duplicates
    std::vector<std::uint32_t> children;
};

/// Returns the size in bytes of the decoded page that `info` describes.
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
    double maxError = 0;          // max stored error of the clusters of this level; finite; the snap error at level 0
    double maxAttributeError = 0; // max attribute error of the clusters of this level; 0 at level 0
};

/// A scalar property of the vertices, besides normal and colour. A vertex stores the value as an integer n of `bits`
/// bits, which means min + n (max - min) / (2^bits - 1). The rounding error is at most half the distance between two
/// values.
struct Field {
    std::string name;
    double min = 0;
    double max = 0;
    std::uint32_t bits = kMaxFieldBits; // from 1 to kMaxFieldBits

    /// Returns the max rounding error of a stored field value, in the units of the field.
    double error() const { return (max - min) / (2 * static_cast<double>((1U << bits) - 1U)); }

    bool operator==(const Field&) const = default;
};

/// The summary of a model: counts, bounds, grid and options. `gnomon info` prints it.
struct ModelSummary {
    Grid grid;
    Box bounds; // world-space bounds of the snapped source
    std::uint64_t sourceTriangles = 0;
    std::uint64_t sourceVertices = 0;
    std::map<std::string, std::uint64_t> dropped; // per reason: number of dropped triangles of the source
    std::uint64_t coarsestTriangles = 0;          // triangles of all clusters without a coarser cluster
    bool hasNormals = false;
    bool hasColors = false;
    std::vector<LevelInfo> levels;              // finest level first
    std::map<std::string, std::string> options; // the build options that change bytes of the file
    UpAxis up;
    Unit unit = Unit::Metre;
    std::vector<Field> fields; // in the order in which vertices store them

    /// Returns the max error of colours and other attributes over all levels of the model, in world units.
    double attributeError() const {
        double largest = 0;
        for (const LevelInfo& level : levels)
            largest = std::max(largest, level.maxAttributeError);
        return largest;
    }
};

} // namespace gnomon::hierarchy
