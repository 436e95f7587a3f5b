// What penumbrae and the light of the sky cost, and how far off they are: against thousands of directions, and where a
// plan leaves a penumbra out against all of it.
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

/// The light of a picture, and what it took.
struct Drawn {
    render::LightPicture light;
    plan::FramePlan plan;
    int frames = 1;
    double milliseconds = 0;
};

class Bench {
public:
    Bench(const std::string& model, int side)
        : model_(model, gibibytes(1)), side_(side), renderer_(model_, *backend_, {}) {}

    const hierarchy::ModelFile& model() const { return model_; }

    /// The view that a picture has where nothing is asked for.
    plan::View usualView() const {
        plan::View view;
        view.width = view.height = side_;
        view.up = model_.summary().up.direction;
        view.towardsLight = path::usualLight(view.up);
        view.camera = path::framingCamera(
            path::outlineOf(model_), path::vantageOf(std::nullopt, view.up), view.aspect(), radiansFromDegrees(60));
        return view;
    }

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

plan::Quality sunAlone() {
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Exact;
    quality.look.shading = plan::Shading::Lit;
    quality.look.ambient = 0;
    return quality;
}

/// How far apart two pictures are, of pixels that get light without shadows, in shares of that light.
struct Apart {
    double mean = 0;
    double worst = 0;
    double p99 = 0;
    double above = 0; // the share of the pixels that are farther apart than asked
};

Apart apart(
    const render::LightPicture& a, const render::LightPicture& b, const render::LightPicture& full, double asked) {
    std::vector<double> all;
    constexpr float kMinLight = 0.02F; // of less light no share can be told
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

/// Views in which the plan leaves penumbrae out that are just too narrow, and the same with all of the disc.
void printRejected(Bench& bench, int views) {
    plan::Quality quality = sunAlone();
    constexpr int kFrames = 1024;
    constexpr double kOneEdge = 0.1061; // 1 / (3 pi)
    double worst = 0;
    double mean = 0;
    int aboveOneEdge = 0;
    int drawn = 0;
    for (int i = 0; drawn < views && i < 20 * views; ++i) {
        plan::View view =
            tests::shadowTriple(bench.model().summary().bounds, static_cast<std::uint64_t>(i), bench.side(), 256).view;
        constexpr double kWide = 0.01;
        view.sunAngleRadians = kWide;
        quality.lightError = 0.05;
        quality.shadows = plan::ShadowMode::Exact;
        const double widest = bench.draw(view, quality, 1).plan.penumbra.widestPixels;
        if (!(widest > 0)) continue;
        ++drawn;
        view.sunAngleRadians = kWide * 0.999 * plan::minPenumbra(quality.lightError) / widest;
        const Drawn left = bench.draw(view, quality, kFrames);
        const double narrow = left.plan.penumbra.widestPixels;
        quality.lightError = 0.0078; // so that it is not left out, and takes as many frames
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
