// The least depth in view from the tree, against every page and every vertex looked at.
#include "lod/nearest_depth.h"
#include "tests/support/model_views.h"
#include "tests/support/sanitizers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::lod {
namespace {

using tests::ModelInMemory;
using tests::sharedModel;

double depthOf(const glm::dvec3& point, const DetailView& view) {
    return glm::dot(point - view.eye, view.basis.view);
}

bool isShown(const glm::dvec3& point, const DetailView& view) {
    return contains(viewPyramid(view), point);
}

/// The least of all vertices of the finest level that the image shows.
double minShown(const ModelInMemory& model, const DetailView& view) {
    double min = std::numeric_limits<double>::infinity();
    for (const hierarchy::Page* page : model.all) {
        if (page->level != 0) continue;
        for (const hierarchy::Vertex& vertex : page->vertices) {
            const glm::dvec3 p = model.trees.grid().local(vertex.position);
            if (isShown(p, view)) min = std::min(min, depthOf(p, view));
        }
    }
    return min;
}

/// The least of the corners of the finest pages' boxes that reach into a view a twentieth wider.
double minOfBoxes(const ModelInMemory& model, const DetailView& view) {
    DetailView wider = view;
    wider.tanHalfX *= 1.05;
    wider.tanHalfY *= 1.05;
    const ConvexVolume pyramid = viewPyramid(wider);
    double min = std::numeric_limits<double>::infinity();
    for (const hierarchy::PageInfo& info : model.table) {
        const Box box = model.trees.grid().local(info.box);
        if (info.level != 0 || classify(pyramid, box) == Containment::Outside) continue;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p(
                (corner & 1U) != 0 ? box.max.x : box.min.x,
                (corner & 2U) != 0 ? box.max.y : box.min.y,
                (corner & 4U) != 0 ? box.max.z : box.min.z);
            min = std::min(min, depthOf(p, view));
        }
    }
    return std::max(min, 0.0);
}

TEST(NearestDepth, NothingInViewIsNearerAndNoBoxIsForgotten) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Random random(77);
    const ModelInMemory& model = sharedModel();
    int known = 0;
    int outside = 0;
    for (int trial = 0; trial < 400; ++trial) {
        SCOPED_TRACE(trial);
        const DetailView view = tests::randomView(random, model.bounds);
        const double found = nearestDepth(model.trees, view);
        EXPECT_LE(found, minShown(model, view));
        const double expected = minOfBoxes(model, view) * 0.95;
        if (std::isfinite(expected))
            EXPECT_NEAR(found, expected, 1e-5 * model.bounds.extent().x);
        else
            EXPECT_EQ(found, expected);
        known += std::isfinite(found) && found > 0 ? 1 : 0;
        outside += std::isfinite(found) ? 0 : 1;
    }
    EXPECT_GT(known, 100);
    EXPECT_GT(outside, 10);
}

} // namespace
} // namespace gnomon::lod
