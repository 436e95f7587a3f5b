// A model in memory, or some of its pages, with numbers for its groups and clusters across all of them.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_file.h"

#include <span>
#include <vector>

namespace gnomon::verify {

struct LoadedModel {
    hierarchy::ModelSummary summary;
    std::vector<hierarchy::Page> pages;      // empty where one is not there
    std::vector<std::uint32_t> firstGroup;   // by page, one more at the end
    std::vector<std::uint32_t> firstCluster; // by page, one more at the end
    std::vector<std::uint32_t> levels;       // by page, also of those that are not there

    std::uint32_t groupNumber(const hierarchy::GroupRef& ref) const { return firstGroup[ref.page] + ref.group; }

    /// The level whose groups `cluster` of `page` was simplified to: it is part of the surface of each level from there
    /// up to its page's own, whose groups replace it.
    std::uint32_t firstLevelOf(const hierarchy::Page& page, const hierarchy::Cluster& cluster) const {
        if (cluster.refinement == hierarchy::kNone) return 0;
        return levels[page.refinements[cluster.refinement].group.page] + 1;
    }

    const hierarchy::Group& group(const hierarchy::GroupRef& ref) const { return pages[ref.page].groups[ref.group]; }
};

/// Reads `pages` of `file` on all threads. Throws Error if one cannot be read, damaged or not.
LoadedModel loadPages(const hierarchy::ModelFile& file, std::span<const std::uint32_t> pages, Progress& progress);

/// The same with all of them.
LoadedModel loadModel(const hierarchy::ModelFile& file, Progress& progress);

/// Throws Error where the pages of `file` would take more memory once decoded than a thousand times the file and
/// 64 MiB, which no model comes near to.
void requireBelievable(const hierarchy::ModelFile& file);

} // namespace gnomon::verify
