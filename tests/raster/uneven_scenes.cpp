#include "tests/raster/uneven_scenes.h"

#include "core/random.h"
#include "tests/raster/plain_uneven.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <hwy/highway.h>

namespace gnomon::raster {
namespace {

/// The rows of a film seen from both ends: gaps that fall and rise.
std::vector<float> mirroredRows(int count, double ratio) {
    std::vector<float> rows = logarithmicRows(count / 2, ratio);
    for (int i = count / 2; i-- > 0;)
        rows.push_back(-rows[static_cast<std::size_t>(i)]);
    return rows;
}

} // namespace

std::vector<float> logarithmicRows(int count, double ratio) {
    std::vector<float> rows;
    rows.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        rows.push_back(static_cast<float>(-std::pow(ratio, -(i + 0.5) / count)));
    return rows;
}

std::vector<float> evenRows(int count) {
    std::vector<float> rows;
    rows.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        rows.push_back(static_cast<float>((2 * i + 1.0) / count - 1));
    return rows;
}

std::vector<float> randomRows(int count, double ratio, std::uint64_t seed) {
    Random random(seed);
    const double mean = std::log(ratio) / count;
    std::vector<float> rows;
    double at = 1;
    for (int i = 0; i < count; ++i) {
        at *= std::exp(-mean * random.uniform(0.3, 1.7));
        rows.push_back(static_cast<float>(-at));
    }
    return rows;
}

std::vector<std::pair<const char*, std::vector<float>>> kindsOfRows(int count) {
    return {
        {"even", evenRows(count)},
        {"logarithmic, 1e3", logarithmicRows(count, 1e3)},
        {"logarithmic, 1e6", logarithmicRows(count, 1e6)},
        {"random, 2e5", randomRows(count, 2e5, 5)},
        {"mirrored, 1e4", mirroredRows(count, 1e4)}};
}

DrawnDepths drawn(std::span<const Cluster> clusters, const View& view, int width, int height) {
    DrawnDepths result{std::vector<float>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), -7), 0};
    result.fragments = Rasterizer().drawDepth(clusters, view, {result.depths.data(), width, height});
    return result;
}

PlainDepths plainly(std::span<const Cluster> clusters, const View& view, int width, int height) {
    const std::size_t samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    PlainDepths result{std::vector<double>(samples, 1), std::vector<int>(samples), 0};
    visitUnevenSamples(clusters, view, [&](int x, int y, double depth, std::uint32_t /*id*/) {
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        result.depths[at] = std::min(result.depths[at], depth);
        ++result.covers[at];
        ++result.fragments;
    });
    return result;
}

void expectAsPlain(std::span<const Cluster> clusters, const View& view, int width, int height, double slack) {
    const PlainDepths plain = plainly(clusters, view, width, height);
    EXPECT_GT(plain.fragments, 0U);
    std::vector<float> first;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        for (const int threads : {1, 2}) {
            SCOPED_TRACE(std::string(hwy::TargetName(target)) + ", threads " + std::to_string(threads));
            DrawnDepths found;
            tbb::task_arena(threads).execute([&] { found = drawn(clusters, view, width, height); });
            EXPECT_EQ(found.fragments, plain.fragments);
            std::size_t apart = 0;
            double worst = 0;
            for (int y = view.viewport.y0; y < view.viewport.y1; ++y)
                for (int x = view.viewport.x0; x < view.viewport.x1; ++x) {
                    const std::size_t at =
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
                    if (plain.covers[at] == 0 && found.depths[at] != 1) ++apart;
                    worst = std::max(worst, std::abs(found.depths[at] - plain.depths[at]));
                }
            EXPECT_EQ(apart, 0U);
            EXPECT_LE(worst, slack);
            if (first.empty()) first = found.depths;
            EXPECT_TRUE(first == found.depths) << "the same on all";
        }
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}
} // namespace gnomon::raster
