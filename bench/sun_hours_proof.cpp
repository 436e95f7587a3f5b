// Hours of sun against the plain integer loops: the steps that sampled pixels of a plan from above count over a day.
#include "core/random.h"
#include "daylight/sun_hours.h"
#include "daylight/sun_view.h"
#include "executor/software_executor.h"
#include "settings/resolve.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace gnomon {
namespace {

constexpr int kDefaultStepSeconds = 300;
constexpr int kDefaultPixels = 20000;

std::vector<std::uint8_t> sampledPixels(const daylight::SunView& view, std::size_t count) {
    std::vector<std::uint8_t> isAsked(view.count());
    Random random(1);
    for (std::size_t i = 0; i < std::min(count, view.points().size());) {
        std::uint8_t& asked = isAsked[view.points().pixel(random.below(view.points().size()))];
        i += asked == 0 ? 1 : 0;
        asked = 1;
    }
    return isAsked;
}

int compare(const std::string& path, std::size_t pixels, int stepSeconds) {
    const hierarchy::ModelFile model(path, gibibytes(1));
    const auto executor = executor::makeSoftwareExecutor();
    frame::Renderer renderer(model, *executor, {});
    settings::Settings settings;
    settings.side = path::ViewSide::Top;
    const plan::View view = settings::viewOf(settings, model);
    settings::SunPeriod period;
    period.place = {47, 8};
    period.from = *sun::parseCivilTime("2026-06-21T00:00+02:00");
    period.to = *sun::parseCivilTime("2026-06-22T00:00+02:00");
    period.stepSeconds = stepSeconds;
    period.up = view.up;
    const std::vector<daylight::SunStep> steps = daylight::sunSteps(period);
    const std::vector<IntegerLight> lights = daylight::lightsOf(steps);
    daylight::SunView receivers(renderer, view, {}, lights);
    const std::vector<std::uint8_t> isAsked = sampledPixels(receivers, pixels);
    std::vector<std::uint8_t> isLit(receivers.count());
    std::vector<std::uint8_t> isTrulyLit(receivers.count());
    std::vector<std::uint32_t> counted(receivers.count());
    std::vector<std::uint32_t> truth(receivers.count());
    for (const IntegerLight& light : lights) {
        receivers.decide(light, isLit);
        receivers.decidePlainly(light, isAsked, isTrulyLit);
        for (std::size_t i = 0; i < isLit.size(); ++i) {
            counted[i] += isAsked[i] != 0 ? isLit[i] : 0U;
            truth[i] += isTrulyLit[i];
        }
    }
    std::size_t wrong = 0;
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        wrong += counted[i] != truth[i] ? 1 : 0;
        sum += truth[i];
    }
    std::printf(
        "%s: %zu directions, %td pixels, %llu lit steps, %zu pixels with another count\n",
        path.c_str(),
        lights.size(),
        std::count(isAsked.begin(), isAsked.end(), 1),
        static_cast<unsigned long long>(sum),
        wrong);
    return wrong == 0 ? 0 : 1;
}

} // namespace
} // namespace gnomon

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: sun_hours_proof MODEL.gnm [PIXELS [STEP_SECONDS]]\n");
        return 2;
    }
    const int pixels = argc > 2 ? std::atoi(argv[2]) : gnomon::kDefaultPixels;
    const int seconds = argc > 3 ? std::atoi(argv[3]) : gnomon::kDefaultStepSeconds;
    return gnomon::compare(argv[1], static_cast<std::size_t>(pixels), seconds);
}
