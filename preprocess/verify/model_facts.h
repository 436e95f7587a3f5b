// The facts of a model that the rules between pages need: its groups, its refinements, and the check results of single
// pages.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_file.h"
#include "preprocess/verify/check.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::verify {

/// The facts of one page.
struct PageFacts {
    std::uint32_t level = 0;
    hierarchy::LevelInfo sums;        // sums of this page
    std::uint64_t rootTriangles = 0;  // triangles of clusters in root groups
    std::optional<std::string> fault; // the violated rule of page.h, if any
    std::vector<hierarchy::Group> groups;
    std::vector<hierarchy::Refinement> refinements;
    std::vector<bool> isUsed; // per refinement: whether a cluster uses it
    Check nesting;            // nesting of the page's groups
    Check monotoneError;
};

/// Returns the facts of page `number`.
PageFacts factsOf(const hierarchy::Page& page, std::size_t number, const hierarchy::Grid& grid);

/// The facts of all pages of a model.
struct ModelFacts {
    hierarchy::ModelSummary summary;
    std::vector<PageFacts> pages;    // without groups if the page is damaged
    std::vector<std::string> damage; // one line per damaged page
};

/// Reads each page of `file` once, on all threads. The facts need about 200 bytes per group. Throws Error if a page is
/// unreadable. A damaged page does not throw.
ModelFacts readFacts(const hierarchy::ModelFile& file, Progress& progress);

/// Returns the approximate memory of the facts.
Bytes factsBytes(std::span<const hierarchy::PageInfo> pages);

} // namespace gnomon::verify
