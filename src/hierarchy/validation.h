// Checks that a page and the tables of a model obey the rules of the format. Also tests and computes enclosing
// spheres, which each selection of detail needs.
#pragma once

#include "hierarchy/model.h"

#include <optional>
#include <span>
#include <string>

namespace gnomon::hierarchy {

/// The max number of triangles, and also of vertices, of a cluster in the file.
constexpr std::uint32_t kMaxClusterTriangles = 256;
constexpr std::uint32_t kMaxClusterVertices = 256;

/// Returns true if the sphere `outer` contains the sphere `inner`, with a relative tolerance of 1e-9 for rounding.
bool encloses(const Sphere& outer, const Sphere& inner);

/// Returns true if the sphere `outer` contains the box `inner`, with a relative tolerance of 1e-9 for rounding.
bool encloses(const Sphere& outer, const Box& inner);

/// Returns a sphere that encloses all of `spheres`. Its centre is the centre of their bounding box. It is not the
/// smallest such sphere, but it is identical on all platforms.
Sphere enclosingSphere(std::span<const Sphere> spheres);

/// Returns a description of the first rule of the format that `page` violates, or nullopt if the page is valid.
/// Violations are ranges with gaps or overlaps, indices out of range, boxes that differ from the vertices, and bounds
/// or errors that are not finite. Other functions check that bounds are nested.
std::optional<std::string> pageFault(const Page& page);

/// Returns the max uncompressed size, in bytes, of the tables and the geometry of the page that `info` describes.
std::uint64_t maxPlainBytes(const PageInfo& info);

/// Returns a description of the first fault in the level and the counts of a page table row, or nullopt if there is
/// none. Faults are clusters without vertices or with too many vertices, and more decoded or stored bytes than a page
/// may have. All sums are 64-bit numbers.
std::optional<std::string> countsFault(const PageInfo& info);

/// Returns a description of the first fault in the counts, box, bounds, errors or children of a page table row, or
/// nullopt if there is none. `grid` is the vertex grid of the model.
std::optional<std::string> rowFault(const PageInfo& info, const Grid& grid);

/// Returns a description of the first fault of a model's summary, or nullopt if there is none. Faults are a grid
/// outside its limits, bounds that are not a box on the grid, and too many levels.
std::optional<std::string> summaryFault(const ModelSummary& summary);

/// Returns a description of the first contradiction between the page table and the summary of a model, or nullopt if
/// there is none. Contradictions are a missing page or root, a wrong number of levels, and finest pages outside the
/// bounds. Each row and the summary must already be valid.
std::optional<std::string> modelFault(std::span<const PageInfo> pages, const ModelSummary& summary);

/// Returns the reason why a model cannot be drawn, or nullopt if it can be drawn. Drawing uses floats for positions and
/// squared distances. The extent of the model and the grid step are therefore limited.
std::optional<std::string> drawingFault(std::span<const PageInfo> pages, const Grid& grid);

/// Returns the ids of the pages that contain the finer groups of `page`, ascending, without duplicates.
std::vector<std::uint32_t> childPages(const Page& page);

/// Returns the row of the page table for `page`. Its offset, its stored bytes and its checksum are 0.
PageInfo describePage(const Page& page);

} // namespace gnomon::hierarchy
