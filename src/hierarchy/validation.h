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

/// The pages that the refinements of `page` name, each once, ascending.
std::vector<std::uint32_t> childPages(const Page& page);

/// The row of the page table that describes `page`; offset, stored bytes and checksum are left 0.
PageInfo describePage(const Page& page);

} // namespace gnomon::hierarchy
