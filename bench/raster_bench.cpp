// Measures how many triangles per second the software rasteriser draws, for triangles of 0.1 to 100 pixels.
//
// usage: raster_bench [options of Google Benchmark]
//
// The target has 2048x2048 pixels. The benchmarks are:
// - depth: depth buffer only
// - logDepth: depth buffer of a logarithmic shadow map, with far / near = 1000
// - visibility: depth and triangle id per pixel
// - llvmpipeDepth: depth buffer only, drawn by llvmpipe (Mesa) through OpenGL
//
// The name of a benchmark ends with the triangle size in thousandths of a pixel, and the number of threads. The output
// is the time per image in milliseconds, and `triangles/s`. For stable results on a busy machine, interleave the runs:
// raster_bench --benchmark_filter='^(depth|logDepth)/1000/1' --benchmark_repetitions=20
//     --benchmark_enable_random_interleaving=true --benchmark_report_aggregates_only=true
#include "raster/raster.h"
#include "tests/raster/gl_depth.h"
#include "tests/raster/scenes.h"

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace gnomon::raster {
namespace {

constexpr int kSide = 2048; // width and height of the target, in pixels

/// Returns a bumpy sheet of triangles with an area of `pixelsPerTriangle` each. The sheets are cached.
const Scene& sheetOf(double pixelsPerTriangle) {
    static std::map<double, Scene> scenes;
    const auto found = scenes.find(pixelsPerTriangle);
    if (found != scenes.end()) return found->second;
    const double spacing = std::sqrt(2 * pixelsPerTriangle);
    // The number of triangles is limited to one per pixel. A sheet of smaller triangles covers a part of the target.
    const int quads = static_cast<int>(std::ceil(kSide / std::max(spacing, std::sqrt(2.0))));
    return scenes.emplace(pixelsPerTriangle, sheet(quads, quads, spacing, 1)).first->second;
}

constexpr double kDepthRatio = 1000; // far / near of the logarithmic map

/// Returns the position of row `row` of a logarithmic map, as y / w. Row 0 is at -1, and row kSide is at -0.001.
double logRow(double row) {
    return -std::pow(kDepthRatio, -row / kSide);
}

/// Returns the sheet of `sheetOf`, deformed so that it covers the same pixel rows in a logarithmic map.
const Scene& logSheetOf(double pixelsPerTriangle) {
    static std::map<double, Scene> scenes;
    const auto found = scenes.find(pixelsPerTriangle);
    if (found != scenes.end()) return found->second;
    Scene scene;
    for (const Cluster& cluster : sheetOf(pixelsPerTriangle).clusters()) {
        std::vector<std::array<std::uint32_t, 3>> positions;
        for (std::uint32_t i = 0; i < cluster.vertexCount; ++i) {
            const std::uint32_t* p = cluster.positions + std::size_t{3} * i;
            const double row = (static_cast<double>(p[1]) - kSceneCenter) / kFlatPixel;
            const double pixels = (logRow(row) + 1) / 2 * kSide;
            positions.push_back(
                {p[0], kSceneCenter + static_cast<std::uint32_t>(std::lround(pixels * kFlatPixel)), p[2]});
        }
        scene.add(std::move(positions), {cluster.triangles.begin(), cluster.triangles.end()});
    }
    return scenes.emplace(pixelsPerTriangle, std::move(scene)).first->second;
}

/// Runs `draw` on a sheet. The benchmark arguments are the triangle area in thousandths of a pixel, and the number of
/// threads.
template <class Draw>
void run(benchmark::State& state, const Draw& draw, bool isLog = false) {
    const double size = static_cast<double>(state.range(0)) / 1000;
    const Scene& scene = isLog ? logSheetOf(size) : sheetOf(size);
    const std::vector<Cluster> clusters = scene.clusters();
    tbb::task_arena arena(static_cast<int>(state.range(1)));
    for (auto _ : state)
        arena.execute([&] { draw(clusters); });
    state.counters["triangles/s"] = benchmark::Counter(
        static_cast<double>(scene.triangleCount()) * static_cast<double>(state.iterations()),
        benchmark::Counter::kIsRate);
}

void depth(benchmark::State& state) {
    Rasterizer rasterizer;
    std::vector<float> depths(std::size_t{kSide} * kSide);
    run(state, [&](std::span<const Cluster> clusters) {
        rasterizer.drawDepth(clusters, flatView({0, 0, kSide, kSide}), {depths.data(), kSide, kSide});
    });
}

void logDepth(benchmark::State& state) {
    Rasterizer rasterizer;
    std::vector<float> depths(std::size_t{kSide} * kSide);
    std::vector<float> rows(kSide);
    for (int row = 0; row < kSide; ++row)
        rows[static_cast<std::size_t>(row)] = static_cast<float>(logRow(row + 0.5));
    View view = flatView({0, 0, kSide, kSide});
    view.rowPositions = rows;
    run(
        state,
        [&](std::span<const Cluster> clusters) {
            rasterizer.drawDepth(clusters, view, {depths.data(), kSide, kSide});
        },
        true);
}

void visibility(benchmark::State& state) {
    Rasterizer rasterizer;
    std::vector<std::uint64_t> words(std::size_t{kSide} * kSide);
    run(state, [&](std::span<const Cluster> clusters) {
        rasterizer.drawVisibility(clusters, flatView({0, 0, kSide, kSide}), {words.data(), kSide, kSide});
    });
}

/// Draws the depth of the same clusters with llvmpipe. The environment variable LP_NUM_THREADS sets its number of
/// threads.
void llvmpipeDepth(benchmark::State& state) {
    const gl::Context context(gl::Platform::Osmesa);
    const GlDepth gl(context, sheetOf(static_cast<double>(state.range(0)) / 1000).clusters(), kSide);
    run(state, [&](std::span<const Cluster> /*clusters*/) { gl.draw(flatView({0, 0, kSide, kSide}), false); });
}

void sizesAndThreads(benchmark::internal::Benchmark* bench) {
    bench->ArgsProduct({{100, 1000, 10000, 100000}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);
}

BENCHMARK(llvmpipeDepth)->ArgsProduct({{1000, 10000, 100000}, {1}})->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(depth)->Apply(sizesAndThreads);
BENCHMARK(logDepth)->Apply(sizesAndThreads);
BENCHMARK(visibility)->Apply(sizesAndThreads);

} // namespace
} // namespace gnomon::raster
