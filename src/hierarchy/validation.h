// The rules that a page keeps by itself, and the enclosure of spheres on which every cut rests.
#pragma once

#include "hierarchy/model.h"

#include <optional>
#include <span>
#include <string>

namespace gnomon::hierarchy {

/// The most triangles and vertices that a cluster may have in the file.
constexpr std::uint32_t kMaxClusterTriangles = 256;
constexpr std::uint32_t kMaxClusterVertices = 256;

/// Whether `outer` holds all of `inner`, but for rounding of a part in 1e9.
bool encloses(const Sphere& outer, const Sphere& inner);

/// Whether `outer` holds all of `inner`, but for rounding of a part in 1e9.
bool encloses(const Sphere& outer, const Box& inner);

/// A sphere that encloses all of `spheres`, centred on the box around them: not the least, but the same everywhere.
Sphere enclosingSphere(std::span<const Sphere> spheres);

/// What of `page` breaks a rule of page.h: ranges that do not tile, indices out of range, boxes that are not those of
/// the vertices, bounds or errors that are not numbers; nothing if all is well. Nesting is judged elsewhere.
std::optional<std::string> pageFault(const Page& page);

/// The most bytes that the tables and the geometry of the page of a row take before they are packed.
std::uint64_t mostPlainBytes(const PageInfo& info);

/// What of a row's level and counts no page has, in 64 bits: clusters without vertices or with too many, more decoded
/// or stored bytes than a page may have; nothing if all is well.
std::optional<std::string> countsFault(const PageInfo& info);

/// What of a row's counts, box, bounds, errors or children no page of a model on `grid` has; nothing if all is well.
std::optional<std::string> rowFault(const PageInfo& info, const Grid& grid);

/// What of a summary no model has by itself: a grid beyond doubles, bounds that are no box on it, too many levels;
/// nothing if all is well.
std::optional<std::string> summaryFault(const ModelSummary& summary);

/// Where page table and summary contradict each other: no page or no root, levels that are not those of the pages,
/// finest pages outside the bounds; nothing if all is well. Rows and summary must be without fault by themselves.
std::optional<std::string> modelFault(std::span<const PageInfo> pages, const ModelSummary& summary);

/// Why nothing of the model can be drawn: positions are floats then, as are squares of their distances; nothing if it
/// can be.
std::optional<std::string> drawingFault(std::span<const PageInfo> pages, const Grid& grid);

/// The pages that the refinements of `page` name, each once, ascending.
std::vector<std::uint32_t> childPages(const Page& page);

/// The row of the page table that describes `page`; offset, stored bytes and checksum are left 0.
PageInfo describePage(const Page& page);

} // namespace gnomon::hierarchy
