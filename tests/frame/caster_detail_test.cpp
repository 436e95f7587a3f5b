// Casters off screen are as coarse as their texels: what that changes in a picture.
#include "tests/frame/full_casters.h"
#include "tests/support/made_model.h"
#include "tests/support/shadow_triples.h"

#include <gtest/gtest.h>

namespace gnomon::tests {
namespace {

TEST(CasterDetail, ChangesNextToNoPixel) {
    for (const char* kind : {"statue", "plant"}) {
        SCOPED_TRACE(kind);
        const BuiltFile model(kind, 100000);
        double sum = 0;
        int pictures = 0;
        std::uint64_t planned = 0;
        std::uint64_t full = 0;
        for (std::uint64_t i = 0; i < 12; ++i) {
            const ShadowTriple triple = withDefaults(shadowTriple(model.file().summary().bounds, i, 128, 328));
            const CasterDifference found = casterDifference(model.file(), triple.view, triple.quality);
            if (found.fullOffScreenTriangles == 0) continue;
            ++pictures;
            sum += found.wrongFraction;
            planned += found.offScreenTriangles;
            full += found.fullOffScreenTriangles;
        }
        EXPECT_GT(pictures, 4);
        EXPECT_LE(sum, 0.001 * pictures);
        EXPECT_LT(planned * 10, full * 9) << "casters are hardly coarser: this tests nothing";
    }
}

} // namespace
} // namespace gnomon::tests
