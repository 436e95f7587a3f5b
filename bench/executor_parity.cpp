// The software executor against GL on OSMesa over seeded views, lights and settings of a model: what differs, by
// scheme. usage: executor_parity MODEL.gnm TRIPLES [FIRST_SEED]
#include "core/random.h"
#include "gl/shader_library.h"
#include "render/gl_executor.h"
#include "render/renderer.h"
#include "render/software_executor.h"
#include "tests/render/executor_comparison.h"
#include "tests/render/field.h"

#include <cstdio>
#include <cstdlib>
#include <map>

namespace gnomon::render {
namespace {

/// From outside or amid the model, towards it; the light from anywhere above.
plan::View viewOf(const Box& bounds, std::uint64_t seed) {
    Random random(seed);
    plan::View view;
    view.width = view.height = 400;
    const double reach = 0.5 * glm::length(bounds.extent());
    for (int axis = 0; axis < 3; ++axis) {
        view.camera.target[axis] = bounds.center()[axis] + random.uniform(-0.3, 0.3) * bounds.extent()[axis];
        view.camera.eye[axis] = bounds.center()[axis] + random.uniform(-1.3, 1.3) * reach;
        view.towardsLight[axis] = axis == 1 ? random.uniform(0.1, 1) : random.uniform(-1, 1);
    }
    return view;
}

/// Percentages of the image's pixels and of the texels that both cover.
void printRow(const std::string& name, int triples, const ExecutorDifference& found) {
    const auto percent = [](std::size_t part, std::size_t whole) {
        return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
    };
    std::printf(
        "| %s | %d | %.5f | %.4f | %.5f | %.5f | %.1e |\n",
        name.c_str(),
        triples,
        percent(found.coverage, found.pixels),
        percent(found.color, found.pixels),
        percent(found.texelCover, found.texels),
        percent(found.texelWrong, found.texels),
        found.largestTexelDepth);
}

void compareModel(const std::string& path, int triples, std::uint64_t firstSeed) {
    const hierarchy::ModelFile model(path);
    const std::unique_ptr<Executor> ours = makeSoftwareExecutor();
    const std::unique_ptr<Executor> gl = makeGlExecutor(gl::Platform::Osmesa, gl::ShaderLibrary(), gibibytes(1));
    Renderer ourRenderer(model, *ours, {});
    Renderer glRenderer(model, *gl, {});
    ExecutorDifference all;
    std::map<std::string, std::pair<int, ExecutorDifference>> byScheme;
    for (int i = 0; i < triples; ++i) {
        const std::uint64_t seed = firstSeed + static_cast<std::uint64_t>(i);
        const plan::View view = viewOf(model.summary().bounds, seed);
        plan::Quality quality = fieldQuality(seed);
        quality.shadowTexelsWidth = quality.shadowTexelsHeight = 1024;
        FrameOptions options;
        options.overlay = static_cast<Overlay>(seed / 2 % 6);
        ourRenderer.forget();
        glRenderer.forget();
        const Frame frame = ourRenderer.render(view, quality, options);
        glRenderer.render(view, quality, options);
        const ExecutorDifference found = difference(*ours, *gl);
        all += found;
        auto& [count, sum] = byScheme[frame.row.scheme + " " + frame.row.warp];
        ++count;
        sum += found;
    }
    printRow("all", triples, all);
    for (const auto& [scheme, row] : byScheme)
        printRow(scheme, row.first, row.second);
}

} // namespace
} // namespace gnomon::render

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: executor_parity MODEL.gnm TRIPLES [FIRST_SEED]\n");
        return 2;
    }
    std::printf(
        "| scheme | triples | coverage %% | colour %% | texel coverage %% | texels off by over 1e-5 %% | most |\n");
    std::printf("|---|---|---|---|---|---|---|\n");
    const std::uint64_t firstSeed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
    gnomon::render::compareModel(argv[1], std::atoi(argv[2]), firstSeed);
    return 0;
}
