// The edge of a map's shadow in the mean of frames: as straight as what casts it, however coarse the texels.
#include "frame/accumulation.h"
#include "tests/support/drawn_model.h"
#include "tests/support/scene_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace gnomon::frame {
namespace {

/// A long wall on a plain. The edge of its shadow crosses the picture and lies aslant to the texels.
class Wall {
public:
    Wall() : model_(scene()) {
        view_.camera = {{3, 14, 15}, {1, 0, 4.6}, {0, 1, 0}, 0.6};
        view_.width = 192;
        view_.height = 144;
        view_.towardsLight = {0.55, 1, -0.8};
        quality_.look.shading = plan::Shading::Lit;
        quality_.shadowTexelsWidth = quality_.shadowTexelsHeight = 48;
        quality_.zPartitions = 1;
    }

    plan::Quality& quality() { return quality_; }

    render::Picture picture(int samples) {
        FrameOptions options;
        options.isAccumulated = true;
        const Frame frame = model_.draw(view_, quality_, options);
        Accumulation accumulation;
        accumulation.begin(model_.renderer(), frame, samples);
        while (accumulation.samples() < samples)
            accumulation.add();
        return accumulation.picture();
    }

private:
    static tests::TinyModel scene() {
        tests::SceneMesh mesh;
        mesh.addGround(64, 8);
        mesh.addBox({-30, 0, -1}, {30, 4, 0});
        return mesh.model();
    }

    DrawnModel model_;
    plan::View view_;
    plan::Quality quality_;
};

/// By column of the picture, how many rows are dark, by how dark they are: where the shadow's edge is.
std::vector<double> edgeOf(const render::Picture& picture) {
    const auto level = [&](int x, int y) { return static_cast<double>(picture.at(x, y)[1]); };
    double darkest = 255;
    double brightest = 0;
    for (const render::Rgb& pixel : picture.pixels) {
        darkest = std::min<double>(darkest, pixel[1]);
        brightest = std::max<double>(brightest, pixel[1]);
    }
    std::vector<double> edge;
    for (int x = picture.width / 4; x < 3 * picture.width / 4; ++x) {
        double dark = 0;
        for (int y = 0; y < picture.height; ++y)
            dark += (brightest - level(x, y)) / (brightest - darkest);
        edge.push_back(dark);
    }
    return edge;
}

/// The root mean square of what is left of `values` beside their best line.
double unevenness(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    const double middle = (n - 1) / 2;
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double slope = 0;
    double spread = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double x = static_cast<double>(i) - middle;
        slope += x * (values[i] - mean);
        spread += x * x;
    }
    slope /= spread;
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        sum += std::pow(values[i] - mean - slope * (static_cast<double>(i) - middle), 2);
    return std::sqrt(sum / n);
}

double meanOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(MapEdge, HasNoSawTeethInTheMeanOfFrames) {
    Wall wall;
    wall.quality().shadows = plan::ShadowMode::Exact;
    const std::vector<double> exact = edgeOf(wall.picture(16));
    EXPECT_LT(unevenness(exact), 0.11);
    wall.quality().shadows = plan::ShadowMode::Maps;
    using shadow::WarpRule;
    for (const WarpRule rule : {WarpRule::None, WarpRule::Auto, WarpRule::Log}) {
        SCOPED_TRACE(name(rule));
        wall.quality().warp.rule = rule;
        const std::vector<double> one = edgeOf(wall.picture(1));
        const std::vector<double> mean = edgeOf(wall.picture(16));
        if (shadow::rowsOf(rule) == shadow::RowSpacing::Even) {
            EXPECT_GT(unevenness(one), 4 * unevenness(exact)) << "there are no saw teeth to lose";
        }
        EXPECT_LT(unevenness(mean), 1.4 * unevenness(exact));
        EXPECT_LT(std::abs(meanOf(mean) - meanOf(exact)), 3 * unevenness(one)) << "it has moved";
    }
}

TEST(MapEdge, ShiftsAreEvenlySpreadAndTheFirstIsNone) {
    EXPECT_EQ(mapShift(0), glm::dvec2(0));
    for (const int count : {16, 64}) {
        for (const int axis : {0, 1}) {
            std::vector<double> places;
            places.reserve(static_cast<std::size_t>(count));
            for (int sample = 0; sample < count; ++sample)
                places.push_back(mapShift(sample)[axis]);
            std::sort(places.begin(), places.end());
            EXPECT_GE(places.front(), -0.5);
            EXPECT_LT(places.back(), 0.5);
            for (std::size_t i = 1; i < places.size(); ++i)
                EXPECT_LT(places[i] - places[i - 1], 4.5 / count);
        }
    }
}

} // namespace
} // namespace gnomon::frame
