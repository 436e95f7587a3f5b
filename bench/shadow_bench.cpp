// Measures the time to compute the shadow map setup of one frame (matrices, splits and resolutions), in microseconds.
//
// usage: shadow_bench [options of Google Benchmark]
//
// The view frustum has far / near = 1000. The benchmarks are:
// - fourMaps: four slices with logarithmic split depths
// - fourMapsUneven: four slices with split lambda 0.9
// - fourSlicesWithFaces: four slices, each divided into face partitions
// - fourMapsStabilized: four stabilised slices, whose texels do not move with the camera
#include "shadow/setup.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace gnomon::shadow;

/// Computes the shadow map setup for a light that rotates by 0.001 radians per frame. The orientation of the maps then
/// changes in each frame, as in a camera path.
void plan(benchmark::State& state, const ShadowOptions& options) {
    ShadowView view;
    view.frustum.near = 0.1;
    view.frustum.far = 100;
    OrientationState orientation{{0, 1, 0}, {0, 0, 1}};
    double angle = 0.3;
    for (auto _ : state) {
        angle += 0.001;
        view.towardsLight = glm::normalize(glm::dvec3(std::sin(angle), 0.8, std::cos(angle)));
        const ShadowMapSetup setup = shadowMapSetup(view, options, orientation);
        orientation = setup.orientation;
        benchmark::DoNotOptimize(setup.maps.data());
    }
}

void fourMaps(benchmark::State& state) {
    plan(state, {});
}

void fourMapsUneven(benchmark::State& state) {
    ShadowOptions options;
    options.scheme.splitLambda = 0.9;
    plan(state, options);
}

void fourSlicesWithFaces(benchmark::State& state) {
    ShadowOptions options;
    options.scheme.faces = true;
    plan(state, options);
}

void fourMapsStabilized(benchmark::State& state) {
    ShadowOptions options;
    options.stabilized = true;
    plan(state, options);
}

BENCHMARK(fourMaps)->Unit(benchmark::kMicrosecond);
BENCHMARK(fourMapsUneven)->Unit(benchmark::kMicrosecond);
BENCHMARK(fourSlicesWithFaces)->Unit(benchmark::kMicrosecond);
BENCHMARK(fourMapsStabilized)->Unit(benchmark::kMicrosecond);

} // namespace

BENCHMARK_MAIN();
