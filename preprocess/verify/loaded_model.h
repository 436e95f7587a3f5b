// A whole model in memory, every page decoded once, with numbers for its groups and clusters across pages.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_file.h"

#include <string>
#include <vector>

namespace gnomon::verify {

struct LoadedModel {
    hierarchy::ModelSummary summary;
    std::vector<hierarchy::Page> pages;      // empty where a page is damaged
    std::vector<std::string> damage;         // one line for each damaged page
    std::vector<std::uint32_t> firstGroup;   // by page, one more at the end
    std::vector<std::uint32_t> firstCluster; // by page, one more at the end

    std::uint32_t groupNumber(const hierarchy::GroupRef& ref) const { return firstGroup[ref.page] + ref.group; }

    const hierarchy::Group& group(const hierarchy::GroupRef& ref) const { return pages[ref.page].groups[ref.group]; }
};

/// Reads all pages of `file` on all threads. Throws Error where they would take more memory once decoded than a
/// thousand times the file and 64 MiB, which no model comes near to, and if one cannot be read though it is not
/// damaged.
LoadedModel loadModel(const hierarchy::ModelFile& file, Progress& progress);

} // namespace gnomon::verify
