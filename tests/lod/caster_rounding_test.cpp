// Lists of casters in every rounding mode: maps, their volumes, the cut and what receives, made anew by each.
#include "lod/caster_detail.h"
#include "lod/frame_cut.h"
#include "lod/receivers.h"
#include "tests/shadow/rounding_cases.h"
#include "tests/support/model_views.h"
#include "tests/support/rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

namespace gnomon::lod {
namespace {

using tests::sharedModel;

/// What decides about a view's casters, and what comes of it.
struct CasterLists {
    shadow::ShadowMapSetup setup;
    std::vector<ConvexVolume> volumes; // local space, the image's first
    lod::Cut cut;
    std::vector<bool> receives;
};

struct CasterView {
    explicit CasterView(Random& random)
        : detail(tests::randomView(random, sharedModel().bounds)), errorPixels(std::exp(random.uniform(-5, 1))) {
        shown.frustum.near = detail.nearestDepth;
        shown.frustum.far = detail.nearestDepth * std::pow(10.0, random.uniform(0.5, 4));
        shown.frustum.halfFovYRadians = std::atan(detail.tanHalfY);
        shown.frustum.aspect = detail.tanHalfX / detail.tanHalfY;
        shown.towardsLight = shadow::randomLight(random);
        shown.imageHeight = static_cast<int>(detail.heightPixels);
        shown.anchor = {detail.basis, detail.eye};
        options = shadow::randomOptions(random, shown.frustum);
    }

    lod::DetailView detail;
    shadow::ShadowView shown;
    shadow::ShadowOptions options;
    double errorPixels = 1;
};

[[gnu::noinline]] CasterLists listsOf(const CasterView& view) {
    CasterLists result;
    result.setup = shadow::shadowMapSetup(view.shown, view.options, std::nullopt);
    result.volumes.push_back(lod::viewPyramid(view.detail));
    std::vector<lod::CasterDetail> casters;
    for (const shadow::ShadowMap& map : result.setup.maps) {
        result.volumes.push_back(localVolume(map.casterVolume, view.detail));
        casters.push_back(casterDetail(view.detail, map));
    }
    const lod::ErrorRule rule(view.detail, casters);
    const lod::CutQuery query{&sharedModel().trees, sharedModel().all, &rule, view.errorPixels, result.volumes};
    result.cut = lod::cut(query);
    std::vector<ConvexVolume> regions;
    for (const shadow::ShadowMap& map : result.setup.maps)
        regions.push_back(localVolume(map.region.volume, view.detail));
    result.receives = receivingVolumes(query, result.cut.lists.image, regions);
    return result;
}

using Named = std::pair<std::uint32_t, std::uint32_t>; // page and cluster

std::set<Named> clustersIn(const lod::DrawList& list) {
    std::set<Named> found;
    for (const lod::ClusterRange& range : list.ranges)
        for (std::uint32_t c = 0; c < range.clusterCount; ++c)
            found.emplace(range.page, range.firstCluster + c);
    return found;
}

/// How far the side of `box` that reaches furthest into a plane of `volume` lies from that plane, of the plane where
/// that is least, over the size of what is compared.
double marginOfBox(const ConvexVolume& volume, const Box& box, double size) {
    double margin = std::numeric_limits<double>::infinity();
    for (const Plane& plane : volume.planes) {
        const double reach = glm::dot(glm::abs(plane.normal), (box.max - box.min) * 0.5);
        margin =
            std::min(margin, std::abs(plane.signedDistance(box.center()) + reach) / (size + std::abs(plane.offset)));
    }
    return margin;
}

struct ListCounts {
    std::uint64_t lists = 0;
    std::uint64_t clusters = 0;
    std::uint64_t undecided = 0; // of the clusters: so near to a plane that rounding may decide
    std::uint64_t moved = 0;     // in one list and not in the other, all undecided
};

/// Planes of caster volumes are off by at most some 1e-12 of the depth range, which is up to 10^4 times the model.
constexpr double kUndecidedBox = 1e-9;

void expectSameList(
    const ConvexVolume& volume, const lod::DrawList& usual, const lod::DrawList& other, ListCounts& counts) {
    const std::set<Named> a = clustersIn(usual);
    const std::set<Named> b = clustersIn(other);
    const Box& bounds = sharedModel().bounds;
    const double size = glm::length(bounds.min) + glm::length(bounds.max);
    const auto margin = [&](const Named& name) {
        const hierarchy::Page& page = *sharedModel().all[name.first];
        return marginOfBox(volume, sharedModel().trees.grid().local(page.clusters[name.second].box), size);
    };
    ++counts.lists;
    counts.clusters += a.size();
    for (const Named& name : a)
        counts.undecided += margin(name) < kUndecidedBox ? 1 : 0;
    std::vector<Named> moved;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(moved));
    counts.moved += moved.size();
    for (const Named& name : moved)
        EXPECT_LT(margin(name), kUndecidedBox) << "page " << name.first << ", cluster " << name.second;
}

TEST(Rounding, ModesChangeNoListOfCastersUnreported) {
    Random random(shadow::asked("GNOMON_ROUNDING_SEED", 61));
    ListCounts counts;
    for (std::uint64_t trial = shadow::asked("GNOMON_ROUNDING_LISTS", 60); trial > 0; --trial) {
        const CasterView view(random);
        if (shadow::isAtTheJumpOfOrientation(view.shown.towardsLight)) continue;
        const CasterLists usual = listsOf(view);
        for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
            SCOPED_TRACE(testing::Message() << "trial " << trial << ", rounding " << mode);
            CasterLists other;
            {
                const tests::RoundingMode rounding(mode);
                other = listsOf(view);
            }
            EXPECT_EQ(other.cut.lists.image.ranges, usual.cut.lists.image.ranges);
            ASSERT_EQ(other.setup.mapOfPartition, usual.setup.mapOfPartition);
            if (shadow::isAnotherWarp(usual.setup, other.setup)) continue; // reported by the set-up's own test
            EXPECT_EQ(other.receives, usual.receives);
            for (std::size_t v = 1; v < usual.volumes.size(); ++v)
                expectSameList(
                    usual.volumes[v], usual.cut.lists.casters[v - 1], other.cut.lists.casters[v - 1], counts);
        }
    }
    if (std::getenv("GNOMON_ROUNDING_LISTS") != nullptr)
        std::cout << counts.lists << " lists of " << counts.clusters << " clusters, " << counts.undecided
                  << " undecided, " << counts.moved << " in one mode's list alone\n";
    EXPECT_GT(counts.clusters, 10000U);
    EXPECT_LT(counts.undecided * 100, counts.clusters);
}

} // namespace
} // namespace gnomon::lod
