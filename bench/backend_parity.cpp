// Measures how many pixels and shadow map texels differ between the software backend and the OpenGL backend.
//
// usage: backend_parity MODEL.gnm TRIPLES [SIDE] [TEXELS] [FIRST_SEED]
//
// Both backends draw the same TRIPLES of view, light and quality. Triple i uses the seed FIRST_SEED + i (default: 1).
// Images have SIDE x SIDE pixels (default: 400). The shadow maps have TEXELS x TEXELS texels in total (default: 1024).
// OpenGL runs on OSMesa, or on EGL if the environment variable GNOMON_TEST_GL is `egl`.
//
// The program prints a Markdown table with one row for all triples and one row per shadow scheme:
// - coverage %: pixels that only one backend covers, in percent of all pixels
// - colour %: pixels with a colour channel that differs by more than 2 of 255 levels, in percent of all pixels
// - texel coverage %: texels that only one backend covers, in percent of the texels that both backends cover
// - texels apart by over 1e-5 %: texels whose depths differ by more than 1e-5, in percent of the same texels
// - most: max difference of two depths; a shadow map stores depths from 0 to 1
// - software off, OpenGL off: texels of the previous kind whose depth in this backend is wrong. A wrong depth differs
//   by more than 1e-5 from the exact plane of each triangle that covers the texel. The second number is the max error.
#include "bench/exact_depth.h"
#include "core/random.h"
#include "frame/renderer.h"
#include "gl/shader_library.h"
#include "render/gl/gl_backend.h"
#include "render/software_backend.h"
#include "tests/support/backend_comparison.h"
#include "tests/support/field.h"
#include "tests/support/tested_platform.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace gnomon::render {
namespace {

/// Returns a random view of the model. The eye is inside or outside of `bounds`, and looks towards the model. The light
/// comes from a random direction above the horizon. The image has `side` x `side` pixels.
plan::View viewOf(const Box& bounds, int side, std::uint64_t seed) {
    Random random(seed);
    plan::View view;
    view.width = view.height = side;
    const double reach = 0.5 * glm::length(bounds.extent());
    for (int axis = 0; axis < 3; ++axis) {
        view.camera.target[axis] = bounds.center()[axis] + random.uniform(-0.3, 0.3) * bounds.extent()[axis];
        view.camera.eye[axis] = bounds.center()[axis] + random.uniform(-1.3, 1.3) * reach;
        view.towardsLight[axis] = axis == 1 ? random.uniform(0.1, 1) : random.uniform(-1, 1);
    }
    return view;
}

constexpr double kDepthBar = 1e-5; // larger differences of shadow map depths (0 to 1) are counted

/// The depth errors of each backend, in texels where both depths differ by more than kDepthBar. The error is the
/// distance from the depth to the nearest exact plane of a triangle that covers the texel.
struct Verdicts {
    std::size_t oursOff = 0;   // texels with an error above kDepthBar in the software backend
    std::size_t theirsOff = 0; // texels with an error above kDepthBar in OpenGL
    double oursMax = 0;        // max error of the software backend
    double theirsMax = 0;      // max error of OpenGL

    void operator+=(const Verdicts& other) {
        oursOff += other.oursOff;
        theirsOff += other.theirsOff;
        oursMax = std::max(oursMax, other.oursMax);
        theirsMax = std::max(theirsMax, other.theirsMax);
    }
};

/// The differences between both backends, summed over several triples.
struct Findings {
    int triples = 0;
    BackendDifference difference;
    Verdicts verdicts;

    void operator+=(const Findings& other) {
        triples += other.triples;
        difference += other.difference;
        verdicts += other.verdicts;
    }
};

/// Returns the texels of the shadow map of `pass` whose depths in `ours` and `theirs` differ by more than kDepthBar.
/// Texels that only one backend covers are skipped.
std::vector<DisputedTexel> disputed(
    const plan::ShadowPass& pass, const FloatPicture& ours, const FloatPicture& theirs) {
    std::vector<DisputedTexel> result;
    const shadow::TexelRectangle& r = pass.map.rectangle;
    for (int y = r.y; y < r.y + r.height; ++y)
        for (int x = r.x; x < r.x + r.width; ++x) {
            const float a = ours.at(x, y);
            const float b = theirs.at(x, y);
            if (a < 1 && b < 1 && std::abs(double{a} - double{b}) > kDepthBar) result.push_back({x, y, a, b});
        }
    return result;
}

/// Returns the depth errors of both backends in all shadow maps of `frame`, the last frame that both backends drew.
/// `pages` caches the pages of `model`.
Verdicts verdicts(
    const frame::Frame& frame,
    const hierarchy::ModelFile& model,
    std::map<std::uint32_t, hierarchy::Page>& pages,
    Backend& ours,
    Backend& theirs) {
    Verdicts result;
    DrawInputs drawing;
    drawing.plan = &frame.plan;
    drawing.space = frame.space;
    drawing.grid = model.summary().grid;
    drawing.pages = [&](std::uint32_t page) -> const hierarchy::Page& {
        const auto found = pages.find(page);
        return found != pages.end() ? found->second : pages.emplace(page, model.readPage(page)).first->second;
    };
    for (std::size_t pass = 0; pass < frame.plan.passes.size(); ++pass) {
        drawing.casters.push_back(&frame.cut.lists.casters[pass]);
        std::vector<DisputedTexel> texels = disputed(frame.plan.passes[pass], ours.shadowDepth(), theirs.shadowDepth());
        if (texels.empty()) continue;
        judge(drawing, pass, texels);
        for (const DisputedTexel& texel : texels) {
            result.oursOff += texel.oursOff > kDepthBar ? 1 : 0;
            result.theirsOff += texel.theirsOff > kDepthBar ? 1 : 0;
            result.oursMax = std::max(result.oursMax, texel.oursOff);
            result.theirsMax = std::max(result.theirsMax, texel.theirsOff);
        }
    }
    return result;
}

/// Prints one row of the table. Percentages are relative to all pixels, or to the texels that both backends cover.
void printRow(const std::string& name, const Findings& findings) {
    const BackendDifference& found = findings.difference;
    const auto percent = [](std::size_t part, std::size_t whole) {
        return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
    };
    std::printf(
        "| %s | %d | %.5f | %.4f | %.5f | %.5f | %.1e | %.5f, %.1e | %.5f, %.1e |\n",
        name.c_str(),
        findings.triples,
        percent(found.coverage, found.pixels),
        percent(found.color, found.pixels),
        percent(found.texelCover, found.texels),
        percent(found.texelWrong, found.texels),
        found.largestTexelDepth,
        percent(findings.verdicts.oursOff, found.texels),
        findings.verdicts.oursMax,
        percent(findings.verdicts.theirsOff, found.texels),
        findings.verdicts.theirsMax);
}

struct Options {
    std::string model;
    int triples = 0;
    int side = 400;    // width and height of the image, in pixels
    int texels = 1024; // square root of the number of texels of all shadow maps
    std::uint64_t firstSeed = 1;
};

void compareModel(const Options& options) {
    const hierarchy::ModelFile model(options.model);
    const std::unique_ptr<Backend> ours = makeSoftwareBackend();
    const std::unique_ptr<Backend> gl = makeGlBackend(gl::testedPlatform(), gl::ShaderLibrary(), gibibytes(1));
    frame::Renderer ourRenderer(model, *ours, {});
    frame::Renderer glRenderer(model, *gl, {});
    Findings all;
    std::map<std::string, Findings> byScheme;
    std::map<std::uint32_t, hierarchy::Page> pages;
    for (int i = 0; i < options.triples; ++i) {
        const std::uint64_t seed = options.firstSeed + static_cast<std::uint64_t>(i);
        const plan::View view = viewOf(model.summary().bounds, options.side, seed);
        plan::Quality quality = fieldQuality(seed);
        quality.shadowTexelsWidth = quality.shadowTexelsHeight = options.texels;
        frame::FrameOptions frameOptions;
        frameOptions.overlay = static_cast<Overlay>(seed / 2 % 8);
        frameOptions.wantsWholeMaps = true;
        const frame::Frame frame = ourRenderer.render(view, quality, frameOptions);
        glRenderer.render(view, quality, frameOptions);
        const Findings found{1, difference(*ours, *gl), verdicts(frame, model, pages, *ours, *gl)};
        all += found;
        byScheme[frame.row.scheme + " " + frame.row.warp] += found;
    }
    printRow("all", all);
    for (const auto& [scheme, row] : byScheme)
        printRow(scheme, row);
}

} // namespace
} // namespace gnomon::render

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: backend_parity MODEL.gnm TRIPLES [SIDE] [TEXELS] [FIRST_SEED]\n");
        return 2;
    }
    std::printf(
        "| scheme | triples | coverage %% | colour %% | texel coverage %% | texels apart by over 1e-5 %% | most | "
        "software off %%, most | OpenGL off %%, most |\n");
    std::printf("|---|---|---|---|---|---|---|---|---|\n");
    gnomon::render::Options options;
    options.model = argv[1];
    options.triples = std::atoi(argv[2]);
    if (argc > 3) options.side = std::atoi(argv[3]);
    if (argc > 4) options.texels = std::atoi(argv[4]);
    if (argc > 5) options.firstSeed = std::strtoull(argv[5], nullptr, 10);
    gnomon::render::compareModel(options);
    return 0;
}
