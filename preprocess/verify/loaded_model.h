// A model in memory, or some of its pages. Groups and clusters are numbered consecutively across all pages.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_file.h"

#include <span>
#include <vector>

namespace gnomon::verify {

/// The loaded pages of a model, with the numbers of their groups and clusters.
struct LoadedModel {
    hierarchy::ModelSummary summary;
    std::vector<hierarchy::Page> pages;      // one per page; empty if the page is not loaded
    std::vector<std::uint32_t> firstGroup;   // per page: number of its first group; one more entry at the end
    std::vector<std::uint32_t> firstCluster; // per page: number of its first cluster; one more entry at the end
    std::vector<std::uint32_t> levels;       // level of each page, also if the page is not loaded

    std::uint32_t groupNumber(const hierarchy::GroupRef& ref) const { return firstGroup[ref.page] + ref.group; }

    /// Returns the first level of detail whose surface contains `cluster` of `page`. This is the level after the level
    /// of the group that the cluster was simplified from. The cluster is part of all surfaces from this level up to the
    /// level of its page.
    std::uint32_t firstLevelOf(const hierarchy::Page& page, const hierarchy::Cluster& cluster) const {
        if (cluster.refinement == hierarchy::kNone) return 0;
        return levels[page.refinements[cluster.refinement].group.page] + 1;
    }

    const hierarchy::Group& group(const hierarchy::GroupRef& ref) const { return pages[ref.page].groups[ref.group]; }
};

/// Reads the pages of `file` with the numbers `pages`, on all threads. Throws Error if a page is damaged or unreadable.
LoadedModel loadPages(const hierarchy::ModelFile& file, std::span<const std::uint32_t> pages, Progress& progress);

/// Reads all pages of `file`. Throws Error if a page is damaged or unreadable.
LoadedModel loadModel(const hierarchy::ModelFile& file, Progress& progress);

/// Throws Error if the decoded pages of `file` would need more memory than 1024 times the file size plus 64 MiB. No
/// valid model needs so much memory.
void requireBelievable(const hierarchy::ModelFile& file);

} // namespace gnomon::verify
