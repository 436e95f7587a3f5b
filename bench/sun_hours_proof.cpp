// Compares the sun hours of sampled points with a brute-force test with integers.
//
// usage: sun_hours_proof MODEL.gnm [SAMPLES [STEP_SECONDS [vertices]]]
//
// The points are SAMPLES random pixels of the model's top view (default: 20000). With `vertices`, they are random
// vertices of the model at full detail. The Sun moves as on 2026-06-21 at 47 degrees north and 8 degrees east. A time
// step has STEP_SECONDS seconds (default: 300). Both methods count the steps in which each point is sunlit.
//
// The program prints the numbers of Sun directions, points and sunlit steps, and the milliseconds of the fast method.
// It also prints the number of points with different counts. The exit code is 1 if a count differs.
#include "core/random.h"
#include "core/stopwatch.h"
#include "render/software_backend.h"
#include "settings/resolve.h"
#include "sun/point_receivers.h"
#include "sun/sun_hours.h"
#include "sun/sun_view.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace gnomon {
namespace {

constexpr int kDefaultStepSeconds = 300;
constexpr int kDefaultPixels = 20000;

/// Returns a mask with the value 1 for `count` random pixels that show a surface.
std::vector<std::uint8_t> sampledPixels(const sun::SunView& view, std::size_t count) {
    std::vector<std::uint8_t> isRequested(view.count());
    Random random(1);
    for (std::size_t i = 0; i < std::min(count, view.points().size());) {
        std::uint8_t& asked = isRequested[view.points().pixel(random.below(view.points().size()))];
        i += asked == 0 ? 1 : 0;
        asked = 1;
    }
    return isRequested;
}

sun::CivilTime timeOf(const char* text) {
    return *sun::parseCivilTime(text);
}

/// Returns the Sun directions of 24 hours, from midnight local time, while the Sun is above the horizon. `up` is the up
/// direction of the model.
std::vector<IntegerLight> lightsOfADay(const glm::dvec3& up, int stepSeconds) {
    sun::SunPeriod period;
    period.place = {47, 8};
    period.from = timeOf("2026-06-21T00:00+02:00");
    period.to = timeOf("2026-06-22T00:00+02:00");
    period.stepSeconds = stepSeconds;
    period.up = up;
    return sun::lightsOf(sun::sunSteps(period));
}

/// Counts the sunlit steps of the receivers with a non-zero entry in `isRequested`, with both methods. Prints the
/// number of receivers with different counts, and returns 1 if there is one, otherwise 0.
template <class Receivers>
int compare(
    const std::string& what,
    Receivers& receivers,
    const std::vector<std::uint8_t>& isRequested,
    const std::vector<IntegerLight>& lights) {
    std::vector<std::uint8_t> isLit(receivers.count());
    std::vector<std::uint8_t> isTrulyLit(receivers.count());
    std::vector<std::uint32_t> counted(receivers.count());
    std::vector<std::uint32_t> truth(receivers.count());
    double milliseconds = 0;
    for (const IntegerLight& light : lights) {
        const Stopwatch watch;
        receivers.resolve(light, isLit);
        milliseconds += watch.elapsed().count;
        receivers.resolvePlainly(light, isRequested, isTrulyLit);
        for (std::size_t i = 0; i < isLit.size(); ++i) {
            counted[i] += isRequested[i] != 0 ? isLit[i] : 0U;
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
        "%s: %zu directions in %.0f ms, %td of %zu sampled, %llu lit steps, %zu with another count\n",
        what.c_str(),
        lights.size(),
        milliseconds,
        std::count(isRequested.begin(), isRequested.end(), 1),
        receivers.count(),
        static_cast<unsigned long long>(sum),
        wrong);
    return wrong == 0 ? 0 : 1;
}

/// Compares the sunlit steps of `pixels` random pixels of the top view.
int comparePixels(const std::string& path, std::size_t pixels, int stepSeconds) {
    const hierarchy::ModelFile model(path, gibibytes(1));
    const auto backend = render::makeSoftwareBackend();
    frame::Renderer renderer(model, *backend, {});
    settings::Settings settings;
    settings.side = path::ViewSide::Top;
    const plan::View view = settings::viewOf(settings, model);
    const std::vector<IntegerLight> lights = lightsOfADay(view.up, stepSeconds);
    sun::SunView receivers(renderer, view, {}, lights);
    return compare(path, receivers, sampledPixels(receivers, pixels), lights);
}

/// Compares the sunlit steps of `vertices` random vertices of the model at full detail.
int compareVertices(const std::string& path, std::size_t vertices, int stepSeconds) {
    const hierarchy::ModelFile model(path, gibibytes(1));
    NoProgress progress;
    exporter::ExportLimit limit;
    limit.error = model.summary().grid.snapError();
    const exporter::UniformCut cut = exporter::uniformCut(model, limit, progress);
    exporter::CutMesh mesh = cut.mesh;
    exporter::weld(mesh);
    std::vector<glm::i64vec3> cells;
    for (const hierarchy::Vertex& vertex : mesh.vertices)
        cells.emplace_back(vertex.position.x, vertex.position.y, vertex.position.z);
    std::vector<std::uint8_t> isRequested(cells.size());
    Random random(1);
    for (std::size_t i = 0; i < std::min(vertices, cells.size());) {
        std::uint8_t& asked = isRequested[random.below(cells.size())];
        i += asked == 0 ? 1 : 0;
        asked = 1;
    }
    sun::PointReceivers receivers(cut, std::move(cells));
    return compare(
        path + ", vertices", receivers, isRequested, lightsOfADay(model.summary().up.direction, stepSeconds));
}

} // namespace
} // namespace gnomon

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: sun_hours_proof MODEL.gnm [SAMPLES [STEP_SECONDS [vertices]]]\n");
        return 2;
    }
    const int pixels = argc > 2 ? std::atoi(argv[2]) : gnomon::kDefaultPixels;
    const int seconds = argc > 3 ? std::atoi(argv[3]) : gnomon::kDefaultStepSeconds;
    const auto samples = static_cast<std::size_t>(pixels);
    return argc > 4 ? gnomon::compareVertices(argv[1], samples, seconds)
                    : gnomon::comparePixels(argv[1], samples, seconds);
}
