// What the rules between pages need of a model: its groups and what they refine to, and what each page shows by itself.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_file.h"
#include "preprocess/verify/check.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::verify {

/// Of one page.
struct PageFacts {
    std::uint32_t level = 0;
    hierarchy::LevelInfo sums;        // of this page alone
    std::uint64_t rootTriangles = 0;  // of clusters in root groups
    std::optional<std::string> fault; // what of it breaks a rule of page.h
    std::vector<hierarchy::Group> groups;
    std::vector<hierarchy::Refinement> refinements;
    std::vector<bool> isUsed; // per refinement: whether it belongs to a cluster
    Check nesting;            // of its groups, likewise the next
    Check monotoneError;
};

PageFacts factsOf(const hierarchy::Page& page, std::size_t number, const hierarchy::Grid& grid);

struct ModelFacts {
    hierarchy::ModelSummary summary;
    std::vector<PageFacts> pages;    // without groups where one is damaged
    std::vector<std::string> damage; // one line for each damaged page
};

/// Reads each page of `file` once, on all threads, and keeps some 200 bytes of each group. Throws Error if a page
/// cannot be read though it is not damaged.
ModelFacts readFacts(const hierarchy::ModelFile& file, Progress& progress);

/// About what facts take.
Bytes factsBytes(std::span<const hierarchy::PageInfo> pages);

} // namespace gnomon::verify
