// The properties of a model that checks across pages need: its groups, its refinements, and the results of checks
// within single pages.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_file.h"
#include "preprocess/verify/check.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::verify {

/// The properties of one page of a model.
struct PageFacts {
    std::uint32_t level = 0;
    hierarchy::LevelInfo sums;        // total numbers and max errors of this page
    std::uint64_t rootTriangles = 0;  // number of triangles in root groups
    std::optional<std::string> fault; // the violated rule of page.h; empty if the page is valid
    std::vector<hierarchy::Group> groups;
    std::vector<hierarchy::Refinement> refinements;
    std::vector<bool> isUsed; // per refinement: whether a cluster was simplified from it
    Check nesting;            // result of the check of nested bounds within this page
    Check monotoneError;
};

/// Returns the properties of `page`, which has the page number `number`.
PageFacts factsOf(const hierarchy::Page& page, std::size_t number, const hierarchy::Grid& grid);

/// The properties of all pages of a model.
struct ModelFacts {
    hierarchy::ModelSummary summary;
    std::vector<PageFacts> pages;    // a damaged page has no groups
    std::vector<std::string> damage; // one description per damaged page
};

/// Reads each page of `file` once, on all threads, and returns the properties of the model. The result needs about 200
/// bytes per group. Throws Error if a page is unreadable, but not if a page is damaged.
ModelFacts readFacts(const hierarchy::ModelFile& file, Progress& progress);

/// Returns the approximate memory of the ModelFacts of a model with the pages `pages`.
Bytes factsBytes(std::span<const hierarchy::PageInfo> pages);

} // namespace gnomon::verify
