// A cap on triangles: the plan is told of what is drawn under it, and that is no more than it allows.
#include "frame/frame_cuts.h"
#include "frame/renderer.h"
#include "lod/receivers.h"
#include "lod/visible_depths.h"
#include "render/software_backend.h"
#include "tests/support/made_model.h"
#include "tests/support/shadow_triples.h"

#include <gtest/gtest.h>

namespace gnomon::frame {
namespace {

bool areAlike(const shadow::VisibleSlab& a, const shadow::VisibleSlab& b) {
    return a.depths == b.depths && a.box.min == b.box.min && a.box.max == b.box.max;
}

/// Holds the facts of `frame` to a survey with the threshold that the frame is drawn with.
void expectSurveyedAsDrawn(const PreparedFrame& frame, const Residency& residency) {
    const lod::ErrorRule viewAlone(frame.rule->view());
    const std::array volumes = {lod::viewPyramid(frame.rule->view())};
    lod::CutQuery query = cutQuery(residency, frame);
    query.rule = &viewAlone;
    query.volumes = volumes;
    const lod::DrawList image = lod::cut(query).lists.image;
    const std::optional<lod::VisibleDepths> visible = lod::visibleDepthRange(query, image);
    ASSERT_TRUE(visible && frame.facts.visible && frame.facts.light);
    EXPECT_EQ(visible->span, (DepthSpan{frame.facts.visible->nearest, frame.facts.visible->farthest}));
    const std::vector<shadow::VisibleSlab> seen = lod::visibleSlabs(query, image, visible->span);
    const std::vector<shadow::VisibleSlab>& told = frame.facts.light->seen;
    EXPECT_TRUE(std::equal(seen.begin(), seen.end(), told.begin(), told.end(), areAlike));
}

// Casters at the border of the picture want more detail than the picture does, so what fits under the cap without
// them need not with them: triple 361 was surveyed at a finer threshold than it was drawn at.
TEST(TriangleCap, HoldsForSurveyAndDrawingByOneThreshold) {
    const tests::BuiltFile model("plant", 40000);
    const std::unique_ptr<render::Backend> backend = render::makeSoftwareBackend();
    Renderer renderer(model.file(), *backend, {});
    int capped = 0;
    for (std::uint64_t i = 350; i < 370; ++i) {
        SCOPED_TRACE(i);
        tests::ShadowTriple triple = withDefaults(tests::shadowTriple(model.file().summary().bounds, i, 800, 2048));
        triple.quality.maxTriangles = 3000;
        const PreparedFrame frame = renderer.prepare(triple.view, triple.quality);
        if (frame.plan.passes.empty()) continue;
        capped += frame.errorPixels > triple.quality.errorPixels ? 1 : 0;
        EXPECT_LE(frame.cut.lists.image.triangles, 3000U);
        EXPECT_EQ(frame.cut.errorPixels, frame.errorPixels);
        expectSurveyedAsDrawn(frame, renderer.residency());
    }
    EXPECT_GT(capped, 5);
}

} // namespace
} // namespace gnomon::frame
