#include "raytrace/ground_truth.h"

#include "core/check.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon::raytrace {
namespace {

/// Offset of a shadow ray's origin from the surface, as a fraction of the point's distance from the eye. The fraction
/// is the precision of floats at this distance.
constexpr float kRelativeOffset = 0x1.0p-19F;

bool isLitSide(Light light) {
    return light == Light::Dark || light == Light::Lit;
}

/// Marks the edge pixels of a shadow: lit-side pixels that have a lit-side neighbour with a different result. Pairs
/// with a pixel marked in `apart` are skipped.
template <class IsLit>
std::vector<std::uint8_t> edges(
    std::span<const Light> reference, std::size_t width, const IsLit& isLit, std::span<const std::uint8_t> apart = {}) {
    std::vector<std::uint8_t> result(reference.size(), 0);
    const auto join = [&](std::size_t a, std::size_t b) {
        if (!apart.empty() && (apart[a] != 0 || apart[b] != 0)) return;
        if (isLitSide(reference[a]) && isLitSide(reference[b]) && isLit(a) != isLit(b)) result[a] = result[b] = 1;
    };
    for (std::size_t i = 0; i < reference.size(); ++i) {
        if ((i + 1) % width != 0) join(i, i + 1);
        if (i + width < reference.size()) join(i, i + width);
    }
    return result;
}

/// Computes one row or column of a distance transform from the lower envelope of parabolas: d[x] = min over q of (x -
/// q)^2 + f[q].
class Envelope {
public:
    explicit Envelope(std::size_t length) : apex_(length), from_(length + 1), values_(length) {}

    /// Replaces `count` values of a row or column, which are `stride` elements apart, by their distance transform.
    void transform(double* f, std::size_t count, std::size_t stride) {
        for (std::size_t i = 0; i < count; ++i)
            values_[i] = f[i * stride];
        std::size_t last = 0;
        apex_[0] = 0;
        from_[0] = -HUGE_VAL;
        from_[1] = HUGE_VAL;
        for (std::size_t q = 1; q < count; ++q) {
            double start = crossing(q, apex_[last]);
            while (start <= from_[last])
                start = crossing(q, apex_[--last]);
            apex_[++last] = q;
            from_[last] = start;
            from_[last + 1] = HUGE_VAL;
        }
        for (std::size_t x = 0, k = 0; x < count; ++x) {
            while (from_[k + 1] < static_cast<double>(x))
                ++k;
            const double along = static_cast<double>(x) - static_cast<double>(apex_[k]);
            f[x * stride] = along * along + values_[apex_[k]];
        }
    }

private:
    double crossing(std::size_t a, std::size_t b) const {
        const auto x = static_cast<double>(a);
        const auto y = static_cast<double>(b);
        return ((values_[a] + x * x) - (values_[b] + y * y)) / (2 * x - 2 * y);
    }

    std::vector<std::size_t> apex_;
    std::vector<double> from_;
    std::vector<double> values_;
};

double percentile(std::vector<float>& sorted, double fraction) {
    if (sorted.empty()) return 0;
    const auto index = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(sorted.size())));
    return static_cast<double>(sorted[std::clamp<std::size_t>(index, 1, sorted.size()) - 1]);
}

} // namespace

Light litByRay(const Occluders& scene, const SurfacePoint& point, const LightSource& source) {
    if (point.normal == glm::vec3(0)) return Light::Nothing;
    if (!(glm::dot(point.normal, source.from(point.position)) > 0)) return Light::Turned;
    const float off = point.offset + kRelativeOffset * glm::length(point.position);
    const glm::vec3 start = point.position + off * point.normal;
    const Ray ray{start, source.from(start), 0, source.distance(start)};
    return scene.isOccluded(ray) ? Light::Dark : Light::Lit;
}

std::vector<Light> litByRays(const Occluders& scene, std::span<const SurfacePoint> points, const LightSource& source) {
    std::vector<Light> result(points.size());
    constexpr std::size_t kPerTask = 1024;
    tbb::parallel_for(std::size_t{0}, (points.size() + kPerTask - 1) / kPerTask, [&](std::size_t task) {
        for (std::size_t i = task * kPerTask; i < std::min(points.size(), (task + 1) * kPerTask); ++i)
            result[i] = litByRay(scene, points[i], source);
    });
    return result;
}

std::vector<float> distanceTransform(std::span<const std::uint8_t> marked, std::size_t width) {
    GNOMON_CHECK(width > 0 && marked.size() % width == 0);
    const std::size_t height = marked.size() / width;
    const double diagonal = std::hypot(static_cast<double>(width), static_cast<double>(height));
    // the squared distance of unmarked pixels; finite, because the envelope subtracts it from itself
    const double unreached = 4 * diagonal * diagonal;
    std::vector<double> squared(marked.size());
    for (std::size_t i = 0; i < marked.size(); ++i)
        squared[i] = marked[i] != 0 ? 0 : unreached;
    Envelope envelope(std::max(width, height));
    for (std::size_t x = 0; x < width && height > 0; ++x)
        envelope.transform(&squared[x], height, width);
    for (std::size_t y = 0; y < height; ++y)
        envelope.transform(&squared[y * width], width, 1);
    std::vector<float> result(marked.size());
    for (std::size_t i = 0; i < marked.size(); ++i)
        result[i] = static_cast<float>(std::min(diagonal, std::sqrt(squared[i])));
    return result;
}

std::vector<std::uint8_t> shadowEdges(std::span<const Light> reference, std::size_t width) {
    return edges(reference, width, [&](std::size_t i) { return reference[i] == Light::Lit; });
}

ShadowComparison compareShadows(
    std::span<const Light> reference,
    std::span<const std::uint8_t> isLit,
    std::size_t width,
    std::span<const std::uint8_t> apart) {
    GNOMON_CHECK_OP(reference.size(), ==, isLit.size());
    GNOMON_CHECK(apart.empty() || apart.size() == reference.size());
    const std::vector<std::uint8_t> trueEdges = shadowEdges(reference, width);
    const std::vector<std::uint8_t> askedEdges = edges(
        reference, width, [&](std::size_t i) { return reference[i] == Light::Lit; }, apart);
    const std::vector<std::uint8_t> drawnEdges = edges(reference, width, [&](std::size_t i) { return isLit[i] != 0; });
    const std::vector<float> fromTrue = distanceTransform(trueEdges, width);
    const std::vector<float> fromDrawn = distanceTransform(drawnEdges, width);
    ShadowComparison result;
    result.wrongDistances.assign(reference.size(), 0);
    std::vector<float> distances;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        if (!isLitSide(reference[i])) continue;
        ++result.litSidePixels;
        if (drawnEdges[i] != 0) distances.push_back(fromTrue[i]);
        if (askedEdges[i] != 0) distances.push_back(fromDrawn[i]);
        if (trueEdges[i] != 0 && askedEdges[i] == 0) ++result.edgePixelsApart;
        if ((reference[i] == Light::Lit) == (isLit[i] != 0)) continue;
        if (!apart.empty() && apart[i] != 0 && reference[i] == Light::Dark) continue;
        ++result.wrongPixels;
        result.wrongDistances[i] = std::max(1.0F, fromTrue[i]);
        result.worstWrongPixels = std::max(result.worstWrongPixels, static_cast<double>(fromTrue[i]));
    }
    if (result.litSidePixels > 0)
        result.wrongFraction = static_cast<double>(result.wrongPixels) / static_cast<double>(result.litSidePixels);
    result.edgePixels = distances.size();
    std::sort(distances.begin(), distances.end());
    result.edgeMedianPixels = percentile(distances, 0.5);
    result.edgeP99Pixels = percentile(distances, 0.99);
    result.edgeWorstPixels = percentile(distances, 1);
    return result;
}

} // namespace gnomon::raytrace
