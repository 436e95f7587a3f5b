// The rules that a page and the tables of a model must satisfy, and enclosing spheres, which each cut relies on.
#pragma once

#include "hierarchy/model.h"

#include <optional>
#include <span>
#include <string>

namespace gnomon::hierarchy {

/// The max number of triangles and vertices of a cluster in the file.
constexpr std::uint32_t kMaxClusterTriangles = 256;
constexpr std::uint32_t kMaxClusterVertices = 256;

/// Returns true if `outer` contains `inner`, with a relative tolerance of 1e-9 for rounding.
bool encloses(const Sphere& outer, const Sphere& inner);

/// Returns true if `outer` contains `inner`, with a relative tolerance of 1e-9 for rounding.
bool encloses(const Sphere& outer, const Box& inner);

/// Returns a sphere that encloses all of `spheres`, centred at the centre of their box. It is not the smallest sphere,
/// but identical on all platforms.
Sphere enclosingSphere(std::span<const Sphere> spheres);

/// Returns the first violated rule of page.h, or nullopt if `page` is valid. The rules cover ranges that do not tile,
/// indices out of range, boxes that differ from the vertices, and bounds or errors that are not finite. Other functions
/// check the nesting of bounds.
std::optional<std::string> pageFault(const Page& page);

/// Returns the max uncompressed size, in bytes, of the tables and the geometry of the page that `info` describes.
std::uint64_t maxPlainBytes(const PageInfo& info);

/// Returns the first fault of a row's level and counts, or nullopt. Faults are clusters without vertices or with too
/// many, and more decoded or stored bytes than a page may have. All sums have 64 bits.
std::optional<std::string> countsFault(const PageInfo& info);

/// Returns the first fault of a row's counts, box, bounds, errors or children for a model on `grid`, or nullopt.
std::optional<std::string> rowFault(const PageInfo& info, const Grid& grid);

/// Returns the first fault of a summary, or nullopt. Faults are a grid outside its limits, bounds that are not a box on
/// the grid, and too many levels.
std::optional<std::string> summaryFault(const ModelSummary& summary);

/// Returns the first contradiction between page table and summary, or nullopt. Contradictions are a missing page or
/// root, a wrong number of levels, and finest pages outside the bounds. Rows and summary must be valid on their own.
std::optional<std::string> modelFault(std::span<const PageInfo> pages, const ModelSummary& summary);

/// Returns the reason why the model cannot be drawn, or nullopt if it can. Drawing uses floats for positions and
/// squared distances, so extent and step have limits.
std::optional<std::string> drawingFault(std::span<const PageInfo> pages, const Grid& grid);

/// Returns the pages that the refinements of `page` name, without duplicates, ascending.
std::vector<std::uint32_t> childPages(const Page& page);

/// Returns the row of the page table that describes `page`. Offset, stored bytes and checksum are 0.
PageInfo describePage(const Page& page);

} // namespace gnomon::hierarchy
