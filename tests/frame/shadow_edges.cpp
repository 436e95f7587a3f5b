#include "tests/frame/shadow_edges.h"

#include "core/check.h"
#include "raytrace/ground_truth.h"

#include <cmath>

namespace gnomon::tests {
namespace {

constexpr float kSameSurface = 0.01F; // of the depth

bool isRequested(const ReachSample& sample) {
    return sample.sine >= kMinSine;
}

/// 1 for each sample that has one of its four neighbours beside it on the same surface of which `isEdge` says so.
template <class IsEdge>
std::vector<std::uint8_t> marked(const ReachPicture& picture, const IsEdge& isEdge) {
    const std::size_t width = picture.width;
    const std::vector<ReachSample>& samples = picture.samples;
    std::vector<std::uint8_t> marks(samples.size(), 0);
    const auto compare = [&](std::size_t i, std::size_t j) {
        const ReachSample& a = samples[i];
        const ReachSample& b = samples[j];
        if (a.reach == Reach::Nothing || b.reach == Reach::Nothing) return;
        if (!(std::abs(a.depth - b.depth) < kSameSurface * std::min(a.depth, b.depth))) return;
        if (isEdge(a, b)) marks[i] = 1;
        if (isEdge(b, a)) marks[j] = 1;
    };
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if ((i + 1) % width != 0) compare(i, i + 1);
        if (i + width < samples.size()) compare(i, i + width);
    }
    return marks;
}

} // namespace

std::vector<std::uint8_t> shadowEdges(const ReachPicture& picture) {
    return marked(picture, [](const ReachSample& dark, const ReachSample& lit) {
        return dark.reach == Reach::Dark && lit.reach == Reach::Lit && isRequested(dark) && isRequested(lit);
    });
}

std::vector<std::uint8_t> lightEnds(const ReachPicture& picture) {
    return marked(picture, [](const ReachSample& unlit, const ReachSample& lit) {
        return unlit.reach != Reach::Lit && lit.reach == Reach::Lit;
    });
}

std::vector<float> edgeDistances(const ReachPicture& picture, const ReachPicture& other) {
    GNOMON_CHECK(picture.width == other.width && picture.samples.size() == other.samples.size());
    const std::vector<std::uint8_t> edges = shadowEdges(picture);
    std::vector<float> distances = raytrace::distanceTransform(lightEnds(other), other.width);
    for (std::size_t i = 0; i < distances.size(); ++i)
        if (edges[i] == 0) distances[i] = -1;
    return distances;
}

DrawnReach drawReach(
    frame::Renderer& renderer, plan::View view, double errorPixels, int samples, const glm::dvec2& aside) {
    view.width *= samples;
    view.height *= samples;
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Exact;
    quality.errorPixels = errorPixels * samples;
    frame::FrameOptions options;
    options.wantsSurfaces = true;
    options.subpixel = aside;
    DrawnReach drawn{renderer.prepare(view, quality), {}, {}};
    renderer.draw(drawn.frame, options);
    drawn.surfaces = renderer.backend().surfaces();
    const render::FloatPicture depth = renderer.backend().viewDepth();
    const glm::vec3 light = drawn.frame.plan.light.unit();
    drawn.picture.width = static_cast<std::size_t>(view.width);
    for (std::size_t i = 0; i < drawn.surfaces.pixels.size(); ++i) {
        const render::SurfaceSample& surface = drawn.surfaces.pixels[i];
        ReachSample sample;
        if (surface.isSurface > 0) {
            sample.reach = !surface.isLitSide()            ? Reach::Turned
                           : surface.litFraction() >= 0.5F ? Reach::Lit
                                                           : Reach::Dark;
            sample.sine = std::max(0.0F, glm::dot(surface.normal, light));
            sample.depth = depth.pixels[i];
        }
        drawn.picture.samples.push_back(sample);
    }
    return drawn;
}

} // namespace gnomon::tests
