#include "validation/shadow_truth.h"

#include "render/ray_shadows.h"
#include "validation/texel_footprint.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace gnomon::validation {

namespace {

using raytrace::Light;

constexpr double kMinCosine = 0.1; // min cosine between normal and light for which the bias covers the whole slope
constexpr double kContactFootprints = 1.5;

/// An offset of a test point from the surface point of a pixel, in shadow map texels along columns and rows.
struct Offset {
    double column = 0;
    double row = 0;
    double reach = 0; // max absolute value of both offsets
};

/// Returns a grid of offsets over the footprint of a shadow map texel, sorted by distance, nearest first.
std::vector<Offset> neighbourhood() {
    constexpr int kSteps = 6;
    std::vector<Offset> result;
    for (int row = -kSteps; row <= kSteps; ++row)
        for (int column = -kSteps; column <= kSteps; ++column) {
            const double reach = std::max(std::abs(row), std::abs(column)) * kContactFootprints / kSteps;
            if (reach > 0)
                result.push_back({column * kContactFootprints / kSteps, row * kContactFootprints / kSteps, reach});
        }
    std::stable_sort(result.begin(), result.end(), [](const Offset& a, const Offset& b) { return a.reach < b.reach; });
    return result;
}

/// Finds the cause of each pixel with a wrong shadow, by tracing additional rays around the pixel.
class Judge {
public:
    Judge(
        const raytrace::Scene& scene,
        const render::DrawInputs& frame,
        const render::Raster<render::SurfaceSample>& surfaces)
        : scene_(&scene),
          plan_(frame.plan),
          space_(&frame.space),
          surfaces_(&surfaces),
          source_(render::lightSource(frame)),
          offsets_(neighbourhood()) {
        for (const plan::ShadowPass& pass : frame.plan->passes)
            probes_.emplace_back(frame, pass.map);
    }

    ShadowVerdict verdict(std::size_t pixel, Light truth) const {
        const render::SurfaceSample& surface = surfaces_->pixels[pixel];
        const ShadowVerdict unexplained = truth == Light::Lit ? ShadowVerdict::FalseShadow : ShadowVerdict::Leak;
        if (surface.partition() < 0) return unexplained;
        const Receiver receiver = receiverOf(surface);
        if (truth == Light::Dark && isThin(receiver, truth)) return ShadowVerdict::Missed;
        for (const Offset& offset : offsets_) {
            if (offset.reach > 1 && truth == Light::Lit) break;
            if (truthAt(receiver, offset) == (truth == Light::Lit ? Light::Dark : Light::Lit))
                return offset.reach > 1 ? ShadowVerdict::ContactGap : ShadowVerdict::NearEdge;
        }
        if (truth == Light::Dark && isTouched(receiver)) return ShadowVerdict::ContactGap;
        return unexplained;
    }

    /// Returns true if the shadow or the lit gap at an edge pixel is too fine for the texels of its shadow map: if it
    /// is narrower than a texel, or if it is a contact shadow, whose caster is very near.
    bool isTooFine(std::size_t pixel, Light truth) const {
        const render::SurfaceSample& surface = surfaces_->pixels[pixel];
        if (surface.partition() < 0) return false;
        const Receiver receiver = receiverOf(surface);
        return isThin(receiver, truth) || (truth == Light::Dark && isTouched(receiver));
    }

private:
    struct Receiver {
        glm::vec3 position{0};
        glm::vec3 normal{0};
        glm::vec3 column{0}; // the footprint of a shadow map texel on the plane of the receiver, along columns and rows
        glm::vec3 row{0};
        glm::vec3 light{0, 1, 0}; // unit direction to the light
        float offset = 0;         // offset of a shadow ray's origin from the surface
    };

    Receiver receiverOf(const render::SurfaceSample& surface) const {
        const glm::dvec3 p(surface.position);
        const auto partition = static_cast<std::size_t>(surface.partition());
        const double kernel = std::max(1, plan_->quality.filter);
        const double pixel = render::pixelWidth(*plan_, *space_, p);
        const TexelFootprint texel = probes_[partition].footprint(p, kStepOverPixel * pixel);
        const glm::vec3 light = source_.from(surface.position);
        const float cosine = std::max(glm::dot(surface.normal, light), static_cast<float>(kMinCosine));
        const auto onPlane = [&](const glm::dvec3& across) {
            const glm::vec3 a(kernel * across);
            return a - light * (glm::dot(surface.normal, a) / cosine);
        };
        return {
            surface.position,
            surface.normal,
            onPlane(texel.column),
            onPlane(texel.row),
            light,
            static_cast<float>(render::kContactTolerancePixels * pixel)};
    }

    /// Traces a ray from the surface at `offset` from the receiver, on the plane of the receiver, and returns its
    /// result. Returns Nothing if there is no surface.
    Light truthAt(const Receiver& receiver, const Offset& offset) const {
        const glm::vec3 moved = receiver.position + static_cast<float>(offset.column) * receiver.column +
                                static_cast<float>(offset.row) * receiver.row;
        const float reach = 0.5F * (glm::length(receiver.column) + glm::length(receiver.row));
        const auto hit = scene_->firstHit({moved + reach * receiver.light, -receiver.light, 0, 2 * reach});
        if (!hit) return Light::Nothing;
        const raytrace::SurfacePoint point{
            moved + (reach - hit->distance) * receiver.light, hit->normal, receiver.offset};
        return raytrace::litByRay(*scene_, point, source_);
    }

    /// Returns true if a caster is within 1.5 texel footprints of the receiver, along the light.
    bool isTouched(const Receiver& receiver) const {
        const float footprint = std::max(glm::length(receiver.column), glm::length(receiver.row));
        const glm::vec3 from = receiver.position + receiver.offset * receiver.normal;
        return scene_->isOccluded(
            {from,
             receiver.light,
             0,
             std::min(static_cast<float>(kContactFootprints) * footprint, source_.distance(from))});
    }

    /// Returns true if the shadow at the receiver is narrower than a texel along columns or rows, so that there is
    /// light on both sides less than a texel apart. Also returns true for such a narrow lit gap between dark sides.
    bool isThin(const Receiver& receiver, Light truth) const {
        const Light other = truth == Light::Dark ? Light::Lit : Light::Dark;
        constexpr int kSteps = 8;
        for (const bool alongRows : {false, true}) {
            const glm::vec3& side = alongRows ? receiver.row : receiver.column;
            // For each side, the first step with the opposite result.
            std::array<int, 2> nearest = {kSteps + 1, kSteps + 1};
            for (const int sign : {0, 1})
                for (int step = 1; step < kSteps; ++step) {
                    const float along = static_cast<float>(sign == 0 ? -step : step) / kSteps;
                    const raytrace::SurfacePoint point{
                        receiver.position + along * side, receiver.normal, receiver.offset};
                    if (raytrace::litByRay(*scene_, point, source_) != other) continue;
                    nearest[static_cast<std::size_t>(sign)] = step;
                    break;
                }
            if (nearest[0] + nearest[1] <= kSteps) return true;
        }
        return false;
    }

    const raytrace::Scene* scene_;
    const plan::FramePlan* plan_;
    const render::CameraRelativeSpace* space_;
    const render::Raster<render::SurfaceSample>* surfaces_;
    raytrace::LightSource source_;
    std::vector<Offset> offsets_;
    std::vector<TexelProbe> probes_;
};

/// Counts the results in `truth.verdicts`. Pixels whose surface is at a grazing angle to the light are
/// only counted as missed, not as judged or unexplained.
void countVerdicts(
    const render::Raster<render::SurfaceSample>& surfaces, const raytrace::LightSource& source, ShadowTruth& truth) {
    for (std::size_t i = 0; i < truth.verdicts.size(); ++i) {
        const ShadowVerdict verdict = truth.verdicts[i];
        if (verdict == ShadowVerdict::Unasked) continue;
        if (verdict == ShadowVerdict::Missed) ++truth.missedPixels;
        const render::SurfaceSample& surface = surfaces.pixels[i];
        if (!(glm::dot(surface.normal, source.from(surface.position)) > static_cast<float>(kMinCosine))) continue;
        ++truth.judgedPixels;
        const bool isUnexplained = verdict == ShadowVerdict::FalseShadow || verdict == ShadowVerdict::Leak;
        truth.unexplainedPixels += isUnexplained ? 1U : 0U;
    }
}

double share(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

} // namespace

double ShadowTruth::missedFraction() const {
    return share(missedPixels, shadows.litSidePixels);
}

double ShadowTruth::unexplainedFraction() const {
    return share(unexplainedPixels, judgedPixels);
}

ShadowTruth shadowTruth(
    const raytrace::Scene& scene,
    const render::DrawInputs& frame,
    const render::Raster<render::SurfaceSample>& surfaces,
    std::span<const Light> light) {
    const auto width = static_cast<std::size_t>(surfaces.width);
    const std::size_t count = surfaces.pixels.size();
    std::vector<std::uint8_t> isLit(count);
    for (std::size_t i = 0; i < count; ++i)
        isLit[i] = surfaces.pixels[i].isLitSide() && surfaces.pixels[i].litFraction() >= 0.5F ? 1 : 0;
    const Judge judge(scene, frame, surfaces);
    ShadowTruth truth;
    truth.verdicts.assign(count, ShadowVerdict::Unasked);
    const std::vector<std::uint8_t> isEdge = raytrace::shadowEdges(light, width);
    std::vector<std::uint8_t> apart(count, 0);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        if (light[i] != Light::Lit && light[i] != Light::Dark) return;
        const bool isRight = (light[i] == Light::Lit) == (isLit[i] != 0);
        truth.verdicts[i] = isRight ? ShadowVerdict::Right : judge.verdict(i, light[i]);
        if (truth.verdicts[i] == ShadowVerdict::Missed || (isEdge[i] != 0 && judge.isTooFine(i, light[i])))
            apart[i] = 1;
    });
    countVerdicts(surfaces, render::lightSource(frame), truth);
    truth.shadows = raytrace::compareShadows(light, isLit, width);
    truth.answerable = raytrace::compareShadows(light, isLit, width, apart);
    return truth;
}

} // namespace gnomon::validation
