// Shadow maps and plans of views that genes draw.
#include "objectives.h"
#include "plan/plan_frame.h"
#include "plan/scheme_choice.h"
#include "tests/plan/made_scene.h"
#include "tests/shadow/measured_map.h"
#include "tests/support/random_views.h"

#include <array>
#include <cmath>
#include <sstream>

namespace gnomon::torture {

namespace {

using namespace shadow;

struct MadeMaps {
    explicit MadeMaps(Genes& genes)
        : view(randomView(genes)), options(randomOptions(genes, view.frustum)), setup(shadowMapSetup(view, options)) {}

    ShadowView view;
    ShadowOptions options;
    ShadowMapSetup setup;
};

std::string inWords(const glm::dvec3& v) {
    std::ostringstream text;
    text.precision(17);
    text << "(" << v.x << ", " << v.y << ", " << v.z << ")";
    return text.str();
}

std::string inWords(const ShadowView& view, const ShadowOptions& options) {
    std::ostringstream text;
    text.precision(17);
    const Scheme& scheme = options.scheme;
    text << "near " << view.frustum.near << " far " << view.frustum.far << " half angle "
         << view.frustum.halfFovYRadians << " aspect " << view.frustum.aspect << " towards light "
         << inWords(view.towardsLight) << " image " << view.imageHeight << " warp " << name(scheme.warp.rule)
         << " slices " << scheme.slices << " lambda " << scheme.splitLambda << " faces " << scheme.faces
         << " near face " << static_cast<int>(scheme.nearFace) << " bisector " << static_cast<int>(scheme.bisector)
         << " chosen orientation " << options.chosenOrientation << " stabilized " << options.stabilized << " filter "
         << options.filterTexels << " texels " << options.texels;
    return text.str();
}

/// Next to a warp's centre of projection differences have no digits left to measure by.
bool isMeasurable(const ShadowMap& map) {
    return map.warped.kappa * map.warped.length <= 1e7;
}

/// The vertices of a map's region, and points between them.
std::vector<glm::dvec3> pointsOf(const ShadowMap& map, Genes& genes) {
    std::vector<glm::dvec3> points;
    for (const FitVertex& vertex : map.region.vertices)
        if (vertex.end != DepthEnd::WithoutBound) points.push_back(vertex.position);
    const std::size_t corners = points.size();
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3& a = points[genes.below(corners)];
        const glm::dvec3& b = points[genes.below(corners)];
        const double share = genes.unit();
        points.push_back(a + (b - a) * share);
        points.push_back((points[corners + static_cast<std::size_t>(i)] + points[genes.below(corners)]) * 0.5);
    }
    return points;
}

Score boundScore(Genes genes, Words words) {
    MadeMaps made(genes);
    made.options.filterTexels = 0;
    made.setup = shadowMapSetup(made.view, made.options);
    Score score;
    for (const ShadowMap& map : made.setup.maps) {
        if (!isMeasurable(map)) continue;
        for (const glm::dvec3& p : pointsOf(map, genes)) {
            const Measured found = measuredAt(map, made.view, p);
            const double ratio = std::max(
                {found.x / map.aliasingBound.x,
                 found.z / map.aliasingBound.z,
                 found.sheared / map.aliasingBound.sheared});
            if (!(ratio > score.value)) continue;
            score.value = ratio;
            if (words == Words::Yes)
                score.where = inWords(made.view, made.options) + "; map of " + name(map.region.face) + " of slice " +
                              std::to_string(map.region.slice) + " at " + inWords(p);
        }
    }
    return score;
}

Score biasScore(Genes genes, Words words) {
    const MadeMaps made(genes);
    Receiver receiver;
    receiver.map = made.setup.maps[genes.below(made.setup.maps.size())];
    receiver.filterTexels = made.options.filterTexels;
    receiver.p = pointsOf(receiver.map, genes)[genes.below(12)];
    receiver.normal = randomDirection(genes);
    receiver.cosine = glm::dot(receiver.normal, made.view.towardsLight);
    if (!isMeasurable(receiver.map) || receiver.cosine < kMinCosine) return {receiver.cosine - 1, "nothing to measure"};
    Score score{largestRise(receiver) / receiver.bias()};
    if (words == Words::Yes)
        score.where = inWords(made.view, made.options) + "; map of " + name(receiver.map.region.face) + " at " +
                      inWords(receiver.p) + " normal " + inWords(receiver.normal);
    return score;
}

/// 1 plus how far a lookup lies outside of its map, in texels; less where it is inside.
Score lookupScore(Genes genes, Words words) {
    ShadowView view = randomView(genes);
    const ShadowOptions options = randomOptions(genes, view.frustum);
    if (genes.below(3) == 0) view.shown = shownOutside(genes, view.frustum);
    const DepthSpan all = view.shown.value_or(DepthSpan{view.frustum.near, view.frustum.far});
    const ShadowMapSetup setup = shadowMapSetup(view, options);
    Score score;
    for (int i = 0; i < 12; ++i) {
        glm::dvec3 p = randomPointIn(genes, slice(view.frustum, all.near, all.far));
        if (i % 3 == 0) p *= setup.selector.splits[genes.below(setup.selector.splits.size())] / p.z;
        const std::size_t index = setup.mapOf(p);
        if (index >= setup.maps.size()) return {1e9, "no map at " + inWords(p)};
        const double outside = 1 + lookupOutside(setup.maps[index], options.filterTexels, p);
        if (!(outside > score.value)) continue;
        score.value = outside;
        if (words == Words::Yes) score.where = inWords(view, options) + "; at " + inWords(p);
    }
    return score;
}

plan::Quality openQuality(Genes& genes) {
    plan::Quality quality;
    if (genes.below(2) == 0)
        quality.zPartitions.reset();
    else
        quality.zPartitions = 1 + static_cast<int>(genes.below(4));
    quality.facePartitions = genes.below(2) == 0 ? plan::Choice::Auto : plan::Choice::Off;
    quality.warp.rule = std::array{WarpRule::Auto, WarpRule::Minimax, WarpRule::Log}[genes.below(3)];
    quality.stabilize = genes.below(8) == 0;
    quality.maxAliasing = std::exp(genes.uniform(-0.5, 2.5));
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 512 << genes.below(3);
    return quality;
}

/// The promise of the worse of two plans over that of the better, with ten for each thing that is not alike.
double jumpBetween(const plan::FramePlan& a, const plan::FramePlan& b) {
    double jump = 1;
    if (a.passes.size() != b.passes.size() || a.hasFaces != b.hasFaces || plan::schemeName(a) != plan::schemeName(b))
        jump += 10;
    if (a.textureWidth != b.textureWidth || a.textureHeight != b.textureHeight) jump += 10;
    constexpr double kMinStep = 1e-3; // less than one of near; on its floor near follows far, as views do
    if (std::abs(a.near - b.near) > kMinStep * a.near) jump += 10;
    if (a.passes.empty() || b.passes.empty()) return jump;
    const double ratio = a.aliasingBound.worst() / b.aliasingBound.worst();
    return jump * std::max(ratio, 1 / ratio);
}

/// A view that has stood still for some frames, and the one beside it.
Score jumpScore(Genes genes, Words words) {
    const plan::MadeScene scene(genes.below(64));
    plan::View view = plan::madeViewFrom(genes);
    const plan::Quality quality = openQuality(genes);
    const plan::Capabilities backend{.unevenRows = genes.below(3) != 0};
    const glm::dvec3 step = randomDirection(genes) * std::pow(10.0, genes.uniform(-9, -6));
    constexpr int kStill =
        14; // frames: near waits for less (plan/hysteresis.h), and a scheme goes at once or after more
    plan::PlannedFrame now = plan::planFrame(view, quality, scene.facts(view), {}, backend);
    plan::FramePlan before = now.plan;
    for (int frame = 0; frame < kStill; ++frame) {
        before = now.plan;
        now = plan::planFrame(view, quality, scene.facts(view), now.memory, backend);
    }
    Score score{jumpBetween(before, now.plan)}; // a plan of a view that stands still may not swing
    const bool isSwinging = score.value > 1.001;
    view.camera.eye += step;
    view.camera.target += step;
    const plan::PlannedFrame beside = plan::planFrame(view, quality, scene.facts(view), now.memory, backend);
    score.value = std::max(score.value, jumpBetween(now.plan, beside.plan));
    if (words == Words::Yes) {
        std::ostringstream text;
        text.precision(17);
        text << (isSwinging ? "while it stands still" : "from one to the next") << ": " << plan::schemeName(now.plan)
             << " of " << now.plan.passes.size() << " maps, " << now.plan.textureWidth << "x" << now.plan.textureHeight
             << ", near " << now.plan.near << ", promises " << now.plan.aliasingBound.worst() << "; then "
             << plan::schemeName(beside.plan) << " of " << beside.plan.passes.size() << ", " << beside.plan.textureWidth
             << "x" << beside.plan.textureHeight << ", near " << beside.plan.near << ", promises "
             << beside.plan.aliasingBound.worst() << "; eye " << inWords(view.camera.eye) << " step " << inWords(step);
        score.where = text.str();
    }
    return score;
}

} // namespace

std::vector<Objective> viewObjectives() {
    return {
        {"promise", "measured over promised aliasing", 70, 1 + 1e-7, 1, boundScore},
        {"bias", "rise of the receiver's plane over its bias", 70, 1 + 1e-6, 1, biasScore},
        {"lookup", "1 and the texels by which a lookup leaves its map", 90, 1, 1, lookupScore},
        {"jump", "promises of views beside each other, and 10 for each change of the plan", 26, 1.001, 50, jumpScore},
    };
}

} // namespace gnomon::torture
