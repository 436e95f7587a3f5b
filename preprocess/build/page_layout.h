// From levels to the pages of a .gnm: which group lies where, and the pages themselves.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_writer.h"
#include "preprocess/build/level.h"

namespace gnomon::preprocess {

/// Where the groups of all levels lie in the file: coarsest level first, groups in the order of their level.
class PageLayout {
public:
    explicit PageLayout(const std::vector<Level>& levels);

    std::uint32_t pageCount() const { return static_cast<std::uint32_t>(pages_.size()); }

    hierarchy::GroupRef place(std::uint32_t level, std::uint32_t group) const { return places_[level][group]; }

    /// The page `id`, decoded.
    hierarchy::Page makePage(const Mesh& mesh, const std::vector<Level>& levels, std::uint32_t id) const;

private:
    struct PageSpan {
        std::uint32_t level = 0;
        std::uint32_t firstGroup = 0;
        std::uint32_t groupCount = 0;
    };

    std::vector<PageSpan> pages_;
    std::vector<std::vector<hierarchy::GroupRef>> places_; // level, group
};

/// Encodes and appends all pages, many at a time. Returns how many.
std::uint32_t writePages(
    const Mesh& mesh, const std::vector<Level>& levels, hierarchy::ModelWriter& writer, Progress& progress);

} // namespace gnomon::preprocess
