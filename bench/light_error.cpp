// Measures the time and the error of penumbrae and sky light that are sampled with few light directions.
//
// usage: light_error disc DEG SIDE MODEL.gnm...        penumbrae of a sun with a diameter of DEG degrees
//        light_error sky SIDE MODEL.gnm...             light of a uniform sky with 16, 64 and 256 directions
//        light_error left-out VIEWS SIDE MODEL.gnm...  penumbrae that the plan skips because they are narrow
//
// Images have SIDE x SIDE pixels, exact shadows and the software backend. `disc` and `sky` use the default view. The
// reference image has 4096 sun directions or 2048 sky directions. Errors are fractions of the pixel's light
// without shadows (`disc`) or without occlusion of the sky (`sky`). `beyond` is the percentage of pixels above the
// error bound.
//
// `left-out` uses VIEWS seeded views. The sun is so small that the widest penumbra is just below the drawing limit. The
// program prints how much a pixel changes if the penumbra is drawn. The difference is divided by the light of the
// brightest pixel and by the penumbra's width in pixels. A straight edge can cause at most 1 / (3 pi) = 0.106.
#include "core/angle.h"
#include "core/stopwatch.h"
#include "frame/accumulation.h"
#include "path/framing.h"
#include "path/outline.h"
#include "plan/light_directions.h"
#include "render/software_backend.h"
#include "tests/support/shadow_triples.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace gnomon {
namespace {

/// The mean light of several frames, with the plan and the cost.
struct Drawn {
    render::LightPicture light;
    plan::FramePlan plan;
    int frames = 1;          // number of averaged frames
    double milliseconds = 0; // wall-clock time of all frames
};

/// Draws images of one model with the software backend.
class Bench {
public:
    Bench(const std::string& model, int side)
        : model_(model, gibibytes(1)), side_(side), renderer_(model_, *backend_, {}) {}

    const hierarchy::ModelFile& model() const { return model_; }

    /// Returns the default view of `gnomon render`, with the default light.
    plan::View usualView() const {
        plan::View view;
        view.width = view.height = side_;
        view.up = model_.summary().up.direction;
        view.towardsLight = path::usualLight(view.up);
        view.camera = path::framingCamera(
            path::outlineOf(model_), path::vantageOf(std::nullopt, view.up), view.aspect(), radiansFromDegrees(60));
        return view;
    }

    /// Draws `samples` frames of `view`, or more if the plan has more light directions, and returns their mean.
    Drawn draw(const plan::View& view, const plan::Quality& quality, int samples) {
        frame::FrameOptions options;
        options.isAccumulated = true;
        const Stopwatch watch;
        const frame::Frame frame = renderer_.render(view, quality, options);
        frame::Accumulation accumulation;
        accumulation.begin(renderer_, frame, samples);
        while (accumulation.samples() < accumulation.wanted())
            accumulation.add();
        Drawn drawn{accumulation.light(), frame.plan, accumulation.wanted(), 0};
        drawn.milliseconds = watch.elapsed().count;
        return drawn;
    }

    int side() const { return side_; }

private:
    hierarchy::ModelFile model_;
    int side_;
    std::unique_ptr<render::Backend> backend_ = render::makeSoftwareBackend();
    frame::Renderer renderer_;
};

/// Returns a quality with exact shadows, and with the sun as the only light.
plan::Quality sunAlone() {
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Exact;
    quality.look.shading = plan::Shading::Lit;
    quality.look.ambient = 0;
    return quality;
}

/// The differences between two images, as fractions of the unoccluded light of each pixel.
struct Apart {
    double mean = 0;
    double worst = 0; // max over all compared pixels
    double p99 = 0;   // 99th percentile
    double above = 0; // fraction of the pixels whose difference exceeds the error bound
};

/// Compares the images `a` and `b`. `full` is the same image without occlusion, and `asked` is the error bound.
/// Pixels without a surface or with little unoccluded light are skipped.
Apart apart(
    const render::LightPicture& a, const render::LightPicture& b, const render::LightPicture& full, double asked) {
    std::vector<double> all;
    constexpr float kMinLight = 0.02F; // pixels with less unoccluded light are skipped
    for (std::size_t i = 0; i < full.pixels.size(); ++i) {
        const float whole = full.pixels[i][1];
        if (whole < kMinLight || a.pixels[i][0] < 0 || b.pixels[i][0] < 0) continue;
        all.push_back(std::abs(a.pixels[i][1] - b.pixels[i][1]) / whole);
    }
    Apart result;
    if (all.empty()) return result;
    std::sort(all.begin(), all.end());
    for (const double each : all) {
        result.mean += each / static_cast<double>(all.size());
        result.above += each > asked ? 1.0 / static_cast<double>(all.size()) : 0;
    }
    result.worst = all.back();
    result.p99 = all[all.size() * 99 / 100];
    return result;
}

/// Prints time and error of penumbrae for the light errors 0.1, 0.05 and 0.02. The sun has a diameter of `degrees`.
void printDisc(Bench& bench, double degrees) {
    plan::View view = bench.usualView();
    plan::Quality quality = sunAlone();
    quality.shadows = plan::ShadowMode::Off;
    const Drawn full = bench.draw(view, quality, 64);
    quality.shadows = plan::ShadowMode::Exact;
    const Drawn point = bench.draw(view, quality, 16);
    view.sunAngleRadians = radiansFromDegrees(degrees);
    quality.lightError = 0.0027;
    const Drawn truth = bench.draw(view, quality, 1);
    std::printf(
        "%d directions %.0f ms, widest %.2f px; a point, 16 frames, %.0f ms\n",
        truth.frames,
        truth.milliseconds,
        truth.plan.penumbra.widestPixels,
        point.milliseconds);
    for (const double error : {0.1, 0.05, 0.02}) {
        quality.lightError = error;
        const Drawn drawn = bench.draw(view, quality, 16);
        const Apart off = apart(drawn.light, truth.light, full.light, error);
        std::printf(
            "disc error %.2f: %4d frames %7.0f ms, off by %.4f in the mean, p99 %.4f, worst %.3f, beyond %.3f%%\n",
            error,
            drawn.frames,
            drawn.milliseconds,
            off.mean,
            off.p99,
            off.worst,
            100 * off.above);
        std::fflush(stdout);
    }
}

/// Prints time and error of the sky light for 16, 64 and 256 directions.
void printSky(Bench& bench) {
    const plan::View view = bench.usualView();
    plan::Quality quality = sunAlone();
    quality.look.ambient = 1;
    const Drawn open = bench.draw(view, quality, 64);
    quality.sky.directions = 2048;
    const Drawn truth = bench.draw(view, quality, 1);
    for (const int directions : {16, 64, 256}) {
        quality.sky.directions = directions;
        const Drawn drawn = bench.draw(view, quality, 1);
        const double bound = plan::skyError(directions, plan::SkyModel::Uniform);
        const Apart off = apart(drawn.light, truth.light, open.light, bound);
        std::printf(
            "sky: %4d frames %7.0f ms, off by %.4f of all light in the mean, p99 %.4f, worst %.3f, beyond %.3f: "
            "%.3f%%\n",
            drawn.frames,
            drawn.milliseconds,
            off.mean,
            off.p99,
            off.worst,
            bound,
            100 * off.above);
        std::fflush(stdout);
    }
}

/// Prints the error of skipped penumbrae, over `views` seeded views. In each view, the widest penumbra is slightly
/// narrower than plan::minPenumbra, so the plan draws the sun as a point.
void printRejected(Bench& bench, int views) {
    plan::Quality quality = sunAlone();
    constexpr int kFrames = 1024;
    constexpr double kOneEdge = 0.1061; // 1 / (3 pi): max error of one straight edge per pixel of penumbra width
    double worst = 0;
    double mean = 0;
    int aboveOneEdge = 0;
    int drawn = 0;
    for (int i = 0; drawn < views && i < 20 * views; ++i) {
        plan::View view =
            tests::shadowTriple(bench.model().summary().bounds, static_cast<std::uint64_t>(i), bench.side(), 256).view;
        constexpr double kWide = 0.01; // radians; the penumbra width is proportional to this angle
        view.sunAngleRadians = kWide;
        quality.lightError = 0.05;
        quality.shadows = plan::ShadowMode::Exact;
        const double widest = bench.draw(view, quality, 1).plan.penumbra.widestPixels;
        if (!(widest > 0)) continue;
        ++drawn;
        view.sunAngleRadians = kWide * 0.999 * plan::minPenumbra(quality.lightError) / widest;
        const Drawn left = bench.draw(view, quality, kFrames);
        const double narrow = left.plan.penumbra.widestPixels;
        quality.lightError = 0.0078; // small enough that the plan draws the penumbra, with 1536 directions
        const Drawn whole = bench.draw(view, quality, kFrames);
        quality.shadows = plan::ShadowMode::Off;
        const Drawn full = bench.draw(view, quality, 16);
        float brightest = 0;
        for (const auto& pixel : full.light.pixels)
            brightest = std::max(brightest, pixel[1]);
        double maxDifference = 0;
        for (std::size_t p = 0; p < full.light.pixels.size(); ++p)
            if (left.light.pixels[p][0] >= 0 && whole.light.pixels[p][0] >= 0)
                maxDifference =
                    std::max<double>(maxDifference, std::abs(left.light.pixels[p][1] - whole.light.pixels[p][1]));
        if (!(brightest > 0)) continue;
        const double times = maxDifference / (brightest * narrow);
        worst = std::max(worst, times);
        mean += times;
        aboveOneEdge += times > kOneEdge ? 1 : 0;
        std::fprintf(stderr, "view %d: %.4f times the width of %.2f pixels\n", drawn, times, narrow);
    }
    std::printf(
        "left out in %d views: full light differs by at most %.3f times the width in pixels, %.3f in the mean of the "
        "views' worst pixels; by more than one edge can in %d\n",
        drawn,
        worst,
        mean / std::max(drawn, 1),
        aboveOneEdge);
}

} // namespace
} // namespace gnomon

int main(int count, char** words) {
    if (count < 4) {
        std::fprintf(
            stderr,
            "light_error disc DEG SIDE MODEL.gnm... | sky SIDE MODEL.gnm... | left-out VIEWS SIDE MODEL.gnm...\n");
        return 2;
    }
    const std::string what = words[1];
    const int first = what == "sky" ? 3 : 4;
    const int side = std::atoi(words[first - 1]);
    for (int i = first; i < count; ++i) {
        std::printf("%s\n", words[i]);
        gnomon::Bench bench(words[i], side);
        if (what == "disc") gnomon::printDisc(bench, std::atof(words[2]));
        if (what == "sky") gnomon::printSky(bench);
        if (what == "left-out") gnomon::printRejected(bench, std::atoi(words[2]));
    }
}
