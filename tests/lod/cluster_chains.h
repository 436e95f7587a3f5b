// Clusters by address, and chains from a finest cluster to a root. Each cut must contain exactly one cluster of each
// chain.
#pragma once

#include "tests/support/model_views.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>
#include <vector>

namespace gnomon::tests {

/// The address of a cluster.
struct ClusterId {
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    auto operator<=>(const ClusterId&) const = default;
};

/// Returns the clusters of a draw list, and checks that the list contains no duplicates.
inline std::set<ClusterId> clustersOf(const lod::DrawList& list) {
    std::set<ClusterId> result;
    for (const lod::ClusterRange& range : list.ranges)
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
            EXPECT_TRUE(result.insert({range.page, c}).second) << "drawn twice";
    return result;
}

/// Random chains from a finest cluster to a root. At each group, a chain continues with a random cluster of those that
/// replace the group.
class Chains {
public:
    explicit Chains(const ModelInMemory& model) : model_(&model) {
        for (std::uint32_t p = 0; p < model.all.size(); ++p)
            for (std::uint32_t g = 0; g < model.all[p]->groups.size(); ++g)
                addGroup(p, g);
    }

    std::vector<ClusterId> randomChain(Random& random) const {
        std::vector<ClusterId> chain{finest_[random.below(finest_.size())]};
        while (true) {
            const hierarchy::GroupRef group = groupOf_.at(chain.back());
            if (model_->all[group.page]->groups[group.group].error == std::numeric_limits<double>::infinity())
                return chain;
            const std::vector<ClusterId>& above = replacements_.at(group);
            chain.push_back(above[random.below(above.size())]);
        }
    }

private:
    void addGroup(std::uint32_t p, std::uint32_t g) {
        const hierarchy::Page& page = *model_->all[p];
        const hierarchy::Group& group = page.groups[g];
        for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
            groupOf_[{p, c}] = {p, g};
            const std::uint32_t refinement = page.clusters[c].refinement;
            if (refinement == hierarchy::kNone)
                finest_.push_back({p, c});
            else
                replacements_[page.refinements[refinement].group].push_back({p, c});
        }
    }

    const ModelInMemory* model_;
    std::map<ClusterId, hierarchy::GroupRef> groupOf_;
    std::map<hierarchy::GroupRef, std::vector<ClusterId>> replacements_;
    std::vector<ClusterId> finest_;
};

} // namespace gnomon::tests
