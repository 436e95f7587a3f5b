// The properties of a model that the checks between pages need: its groups, its refinements, and the results of the
// checks within single pages.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_file.h"
#include "preprocess/verify/check.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::verify {

/// The properties of one page.
struct PageFacts {
    std::uint32_t level = 0;
    hierarchy::LevelInfo sums;        // totals of this page
    std::uint64_t rootTriangles = 0;  // number of triangles of clusters in root groups
    std::optional<std::string> fault; // the rule of page.h that the page violates, if any
    std::vector<hierarchy::Group> groups;
    std::vector<hierarchy::Refinement> refinements;
    std::vector<bool> isUsed; // per refinement: whether a cluster uses it
    Check nesting;            // result of the nesting check within the page
    Check monotoneError;
};

/// Returns the properties of `page`, whose page number is `number`.
PageFacts factsOf(const hierarchy::Page& page, std::size_t number, const hierarchy::Grid& grid);

/// The properties of all pages of a model.
struct ModelFacts {
    hierarchy::ModelSummary summary;
    std::vector<PageFacts> pages;    // a damaged page has no groups here
    std::vector<std::string> damage; // one line per damaged page
};

/// Reads each page of `file` once, on all threads. The result needs about 200 bytes per group. Throws Error if a page
/// is unreadable, but not if a page is damaged.
ModelFacts readFacts(const hierarchy::ModelFile& file, Progress& progress);

/// Returns the approximate memory of the ModelFacts for these pages.
Bytes factsBytes(std::span<const hierarchy::PageInfo> pages);

} // namespace gnomon::verify
