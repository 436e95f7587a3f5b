// Finds the groups of clusters that must not be refined, because a page below them is damaged.
#include "lod/page_store.h"

#include <limits>

namespace gnomon::lod {
namespace {

constexpr double kNoParent = std::numeric_limits<double>::infinity(); // error of a root group

/// Returns true if sphere `outer` may contain sphere `inner`, with a relative tolerance of 1e-6.
bool mayEnclose(const Sphere& outer, const Sphere& inner) {
    return glm::distance(outer.center, inner.center) + inner.radius <= outer.radius * (1 + 1e-6);
}

} // namespace

/// Blocks the refinement of the groups of `page` above damaged pages. A group may be refined only if each group that
/// contains a part of its refinement is also refined. The groups in a damaged page are unknown, but the bounds of the
/// page contain them. Groups outside these bounds are not blocked.
void PageStore::blockGroups(std::uint32_t page) {
    const hierarchy::Page& content = *entries_[page].content;
    const auto block = [&](std::uint32_t group) {
        // a root group has no coarser group above it
        if (content.groups[group].error < kNoParent) blocked_.insert({page, group});
    };
    for (const std::uint32_t parent : entries_[page].parents) {
        if (entries_[parent].state != State::Damaged) {
            blockBelow(parent, page, block);
            continue;
        }
        for (std::uint32_t group = 0; group < content.groups.size(); ++group)
            if (mayEnclose(source_->pages()[parent].bounds, content.groups[group].bounds)) block(group);
    }
}

/// Calls `block` for each group of `page` that refines a blocked group of the page `parent`.
template <class Block>
void PageStore::blockBelow(std::uint32_t parent, std::uint32_t page, const Block& block) const {
    const hierarchy::Page& above = *entries_[parent].content;
    for (auto blocked = blocked_.lower_bound({parent, 0}); blocked != blocked_.end() && blocked->page == parent;
         ++blocked) {
        const hierarchy::Group& group = above.groups[blocked->group];
        for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
            if (above.clusters[c].refinement == hierarchy::kNone) continue;
            const hierarchy::GroupRef& finer = above.refinements[above.clusters[c].refinement].group;
            if (finer.page == page) block(finer.group);
        }
    }
}

} // namespace gnomon::lod
