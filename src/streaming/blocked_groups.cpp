// What a cut must leave as it is below damaged pages.
#include "streaming/page_store.h"

#include <limits>

namespace gnomon::streaming {
namespace {

constexpr double kNoParent = std::numeric_limits<double>::infinity(); // the error of a root group

/// Whether `outer` may hold all of `inner`; errs towards yes by a part in a million.
bool mayEnclose(const Sphere& outer, const Sphere& inner) {
    return glm::distance(outer.center, inner.center) + inner.radius <= outer.radius * (1 + 1e-6);
}

} // namespace

/// A group may be refined only if every group that holds a part of what replaces it is. Which groups a damaged page
/// refines nobody can tell, but its bounds enclose theirs; what its bounds do not enclose it has nothing to do with.
void PageStore::blockGroups(std::uint32_t page) {
    const hierarchy::Page& content = *entries_[page].content;
    const auto block = [&](std::uint32_t group) {
        if (content.groups[group].error < kNoParent) blocked_.insert({page, group}); // a root hangs from nothing
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

/// Calls `block` for the groups of `page` that blocked groups of `parent` refine.
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

} // namespace gnomon::streaming
