// The model that other tests rest on keeps the rules of a hierarchy.
#include "hierarchy/validation.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

namespace gnomon::tests {
namespace {

using namespace hierarchy;

TEST(TinyModel, IsAValidHierarchyOfSeveralLevels) {
    TinyModelOptions options;
    options.gridExponent = 6;
    const TinyModel model = makeTinyModel(options);
    EXPECT_EQ(model.summary.levels[0].triangles, 8192U);
    EXPECT_GE(model.summary.levels.size(), 4U);
    for (std::size_t i = 1; i < model.summary.levels.size(); ++i) {
        EXPECT_LT(model.summary.levels[i].triangles, model.summary.levels[i - 1].triangles * 4 / 5) << "level " << i;
        EXPECT_GT(model.summary.levels[i].maxError, model.summary.levels[i - 1].maxError);
    }
    for (const Page& page : model.pages) {
        EXPECT_EQ(pageFault(page), std::nullopt);
        for (const Group& group : page.groups) {
            EXPECT_TRUE(encloses(group.bounds, model.summary.grid.local(group.box)));
            for (std::uint32_t c = 0; c < group.clusterCount; ++c) {
                const Cluster& cluster = page.clusters[group.firstCluster + c];
                if (cluster.refinement == kNone) continue;
                const Refinement& refinement = page.refinements[cluster.refinement];
                EXPECT_TRUE(encloses(group.bounds, refinement.bounds));
                EXPECT_GE(group.error, refinement.error);
                const Group& finer = model.pages[refinement.group.page].groups[refinement.group.group];
                EXPECT_EQ(finer.error, refinement.error);
                EXPECT_EQ(finer.bounds.radius, refinement.bounds.radius);
            }
        }
    }
}

} // namespace
} // namespace gnomon::tests
