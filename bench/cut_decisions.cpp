// How many decisions of a cut rounding may make: of all groups of a model, under thresholds from an eighth of a pixel
// to eight pixels, seen and lit from anywhere, with four partitions; and how many another rounding mode makes
// otherwise. cut_decisions MODEL.gnm [VIEWS] [SEED]. Exit 1 if a mode decides what was certain.
#include "core/camera.h"
#include "core/random.h"
#include "culling/caster_detail.h"
#include "hierarchy/model_file.h"
#include "selection/decision.h"
#include "shadow/setup.h"

#include <cfenv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace gnomon {
namespace {

struct Counts {
    std::uint64_t decisions = 0;
    std::uint64_t undecided = 0;
    std::uint64_t changed = 0; // by a mode
    std::uint64_t wrong = 0;   // of these, what was certain
};

struct Bounded {
    Sphere bounds;
    double error = 0;
};

std::vector<Bounded> groupsOf(const hierarchy::ModelFile& file) {
    std::vector<Bounded> groups;
    for (std::uint32_t p = 0; p < file.pages().size(); ++p)
        for (const hierarchy::Group& group : file.readPage(p).groups)
            groups.push_back({group.bounds, group.drawnError()});
    return groups;
}

/// A view, and what of shadow maps the rule asks.
struct View {
    View(const hierarchy::ModelSummary& summary, Random& random) {
        const glm::dvec3 extent = summary.bounds.extent();
        const double size = glm::length(extent);
        const auto inBounds = [&](double grown) {
            const glm::dvec3 part(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            return summary.bounds.center() - summary.grid.origin + 0.5 * grown * part * extent;
        };
        Camera camera;
        camera.eye = inBounds(3);
        camera.target = inBounds(1);
        detail.eye = camera.eye;
        detail.basis = cameraBasis(camera);
        detail.nearestDepth = 1e-3 * size;
        shadow::ShadowView shown;
        shown.frustum.near = size * std::pow(10.0, random.uniform(-3, -1));
        shown.frustum.far = 2 * size;
        const glm::dvec3 light(random.uniform(-1, 1), random.uniform(0.01, 1), random.uniform(-1, 1));
        shown.towardsLight = toCamera(detail.basis, glm::normalize(light));
        shadow::ShadowOptions options;
        options.scheme.slices = 4;
        for (const shadow::ShadowMap& map : shadow::shadowMapSetup(shown, options).maps)
            casters.push_back(culling::casterDetail(detail, map));
    }

    selection::DetailView detail;
    std::vector<selection::CasterDetail> casters;
};

[[gnu::noinline]] bool exceedsIn(int mode, const View& view, const Bounded& group, double threshold) {
    std::fesetround(mode);
    const bool exceeds = selection::ErrorRule(view.detail, view.casters).exceeds(group.bounds, group.error, threshold);
    std::fesetround(FE_TONEAREST);
    return exceeds;
}

/// How many of the other modes decide otherwise than `usual`.
std::uint64_t changedModes(const View& view, const Bounded& group, double threshold, bool usual) {
    std::uint64_t changed = 0;
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
        changed += exceedsIn(mode, view, group, threshold) != usual ? 1 : 0;
    return changed;
}

void count(const View& view, const std::vector<Bounded>& groups, Counts& counts) {
    const selection::ErrorRule rule(view.detail, view.casters);
    const selection::CertainRule certain(rule);
    for (const Bounded& group : groups) {
        const selection::Range range = certain.pixels(group.bounds, group.error);
        for (int step = -8; step <= 8; ++step) {
            const double threshold = std::pow(2.0, step * 0.375);
            const bool isUndecided = range.low <= threshold && threshold < range.high;
            ++counts.decisions;
            counts.undecided += isUndecided ? 1 : 0;
            if (!isUndecided && step % 4 != 0) continue; // making the rule anew in each mode takes long
            const bool usual = rule.exceeds(group.bounds, group.error, threshold);
            const std::uint64_t changed = changedModes(view, group, threshold, usual);
            counts.changed += changed;
            counts.wrong += isUndecided ? 0 : changed;
        }
    }
}

int run(int argc, char** argv) {
    const hierarchy::ModelFile file(argv[1]);
    const std::uint64_t views = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 20;
    Random random(argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1);
    const std::vector<Bounded> groups = groupsOf(file);
    Counts counts;
    for (std::uint64_t i = 0; i < views; ++i)
        count(View(file.summary(), random), groups, counts);
    std::printf(
        "%zu groups, %llu views: %llu decisions, %llu undecided, %llu made otherwise in a mode, %llu of them certain\n",
        groups.size(),
        static_cast<unsigned long long>(views),
        static_cast<unsigned long long>(counts.decisions),
        static_cast<unsigned long long>(counts.undecided),
        static_cast<unsigned long long>(counts.changed),
        static_cast<unsigned long long>(counts.wrong));
    return counts.wrong == 0 ? 0 : 1;
}

} // namespace
} // namespace gnomon

int main(int argc, char** argv) {
    if (argc < 2) return 2;
    return gnomon::run(argc, argv);
}
