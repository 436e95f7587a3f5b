#include "selection/decision.h"

namespace gnomon::selection {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Vector = std::array<Range, 3>;

Vector vectorOf(const glm::dvec3& exact) {
    return {exact.x, exact.y, exact.z};
}

Range dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector difference(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// `along` times `scale`, and `across`, of unit length.
Vector normalOf(const glm::dvec3& along, double scale, const glm::dvec3& across) {
    Vector inward;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<int>(i);
        inward[i] = Range(along[axis]) * scale + across[axis];
    }
    const Range inverse = Range(1) / root(dot(inward, inward));
    for (Range& component : inward)
        component = component * inverse;
    return inward;
}

/// What is between `wide` where something is the case, 0 where it is not.
Range where(Decision isTheCase, const Range& wide) {
    if (isTheCase == Decision::Yes) return wide;
    return isTheCase == Decision::No ? Range(0) : hull(0, wide);
}

Decision both(Decision a, Decision b) {
    if (a == Decision::No || b == Decision::No) return Decision::No;
    return a == Decision::Yes ? b : Decision::Undecided;
}

Decision isAtLeast(const Range& value, double bound) {
    if (value.low >= bound) return Decision::Yes;
    return value.high < bound ? Decision::No : Decision::Undecided;
}

Range signedDistance(const Plane& plane, const Vector& point) {
    return dot(vectorOf(plane.normal), point) + plane.offset;
}

Decision touching(const ConvexVolume& volume, const Sphere& sphere) {
    Decision result = Decision::Yes;
    for (const Plane& plane : volume.planes)
        result = both(result, isAtLeast(signedDistance(plane, vectorOf(sphere.center)), -sphere.radius));
    return result;
}

/// Parameters of a line, from 0 on. What half-lines leave of it: {t >= 0: start + slope t >= 0}. As start and slope
/// grow so does what they leave, whatever their signs, so the greatest of both leave the most, and the least the least,
/// however near to 0 a slope comes.
struct RaySpan {
    double first = 0;
    double last = kInfinity;

    /// `rounding`: 1 to keep no less than all, -1 no more.
    void cut(double start, double slope, int rounding) {
        const Range end = slope == 0 ? Range(0) : Range(-start) / slope;
        if (slope > 0)
            first = std::max(first, rounding > 0 ? end.low : end.high);
        else if (slope < 0)
            last = std::min(last, rounding > 0 ? end.high : end.low);
        else if (start < 0)
            last = -1;
    }

    bool isEmpty() const { return first > last; }

    /// The least of start + slope t in it.
    Range least(double start, double slope) const {
        return slope == 0 ? Range(start) : start + Range(slope) * (slope > 0 ? first : last);
    }
};

/// As TexelWidth::smallerSide.
Range smallerSide(const TexelWidth& texel, const Range& zeta) {
    const Range clamped = least(greatest(zeta, 0), texel.depth);
    const Range stretch = 1 + texel.kappa * clamped;
    const Range along = texel.isLog ? texel.length * stretch
                                    : texel.length * stretch * stretch / (1 + Range(texel.kappa) * texel.depth);
    return least(texel.width * stretch, along);
}

} // namespace

CertainRule::CertainRule(const ErrorRule& rule) : rule_(&rule) {
    const DetailView& view = rule.view();
    const CameraBasis& basis = view.basis;
    const Vector eye = vectorOf(view.eye);
    const auto add = [&](double scale, const glm::dvec3& across) {
        const Vector normal = normalOf(basis.view, scale, across);
        pyramid_.push_back({normal, -dot(normal, eye)});
    };
    add(view.tanHalfX, basis.right);
    add(view.tanHalfX, -basis.right);
    add(view.tanHalfY, basis.up);
    add(view.tanHalfY, -basis.up);
    add(1, glm::dvec3(0));
    const Range x = view.tanHalfX;
    const Range y = view.tanHalfY;
    pixelsPerUnit_ = view.heightPixels / (2 * y);
    edgePixelsPerUnit_ = DetailView::kEdgeMargin * pixelsPerUnit_;
    cornerCosine_ = 1 / root(1 + x * x + y * y);
}

Range CertainRule::pixels(const Sphere& bounds, double error) const {
    if (error == kInfinity) return error;
    if (!(error > 0)) return 0;
    Range result = viewPixels(bounds, error);
    for (const CasterDetail& caster : rule_->casters())
        result = greatest(result, casterPixels(caster, bounds, error));
    return result;
}

Decision CertainRule::exceeds(const Sphere& bounds, double error, double threshold) const {
    const Range range = pixels(bounds, error);
    if (range.low > threshold) return Decision::Yes;
    return range.high <= threshold ? Decision::No : Decision::Undecided;
}

Range CertainRule::viewPixels(const Sphere& bounds, double error) const {
    const DetailView& view = rule_->view();
    const Vector center = vectorOf(bounds.center);
    Decision isSeen = Decision::Yes;
    for (const PlaneRange& plane : pyramid_)
        isSeen = both(isSeen, isAtLeast(dot(plane.normal, center) + plane.offset, -bounds.radius));
    if (isSeen == Decision::No) return 0;
    const Vector toCenter = difference(center, vectorOf(view.eye));
    const Range depth = dot(toCenter, vectorOf(view.basis.view));
    const Range squaredDistance = dot(toCenter, toCenter);
    const Range squaredTangent = squaredDistance - Range(bounds.radius) * bounds.radius;
    Range cosine = cornerCosine_;
    if (depth.high > 0 && squaredTangent.high > 0) {
        const Range across = root(squaredDistance - depth * depth);
        const Range reached = (depth * root(squaredTangent) - across * bounds.radius) / squaredDistance;
        cosine.high = std::max(cosine.high, reached.high);
        if (depth.low > 0 && squaredTangent.low > 0) cosine.low = std::max(cosine.low, reached.low);
    }
    return where(isSeen, error * pixelsPerUnit_ / (greatest(depth - bounds.radius, view.nearestDepth) * cosine));
}

/// The least depth at which the light through the sphere meets receivers, less the sphere's radius, and whether it
/// `meets` any.
Range CertainRule::leastReceiverDepth(const CasterDetail& caster, const Sphere& bounds, Decision& meets) const {
    const Vector origin = vectorOf(bounds.center);
    const Vector direction = vectorOf(-caster.towardsLight);
    RaySpan most;
    RaySpan fewest;
    for (const Plane& plane : caster.receivers.planes) {
        const Range start = signedDistance(plane, origin) + bounds.radius;
        const Range slope = dot(vectorOf(plane.normal), direction);
        most.cut(start.high, slope.high, 1);
        fewest.cut(start.low, slope.low, -1);
    }
    meets = most.isEmpty() ? Decision::No : fewest.isEmpty() ? Decision::Undecided : Decision::Yes;
    if (meets == Decision::No) return 0;
    const Vector view = vectorOf(rule_->view().basis.view);
    const Range start = dot(difference(origin, vectorOf(rule_->view().eye)), view);
    const Range slope = dot(direction, view);
    const Range nearest = most.least(start.low, slope.low);
    const Range farthest = meets == Decision::Yes ? fewest.least(start.high, slope.high) : Range(kInfinity);
    return Range(nearest.low, farthest.high) - bounds.radius;
}

Range CertainRule::casterPixels(const CasterDetail& caster, const Sphere& bounds, double error) const {
    Decision isSeen = touching(caster.casters, bounds);
    if (isSeen == Decision::No) return 0;
    if (caster.point) {
        constexpr double kNearest = 1e-6; // as in ErrorRule
        const Vector toCenter = difference(vectorOf(bounds.center), vectorOf(caster.point->at));
        const Range from = root(dot(toCenter, toCenter)) - bounds.radius;
        const Range farthest = caster.point->farthest;
        const Range growth = greatest(1, farthest / greatest(from, kNearest * farthest));
        return where(isSeen, error * growth * edgePixelsPerUnit_ / caster.receiverNear);
    }
    const TexelWidth& texel = caster.texel;
    const Range zeta = dot(vectorOf(texel.axis), vectorOf(bounds.center)) - texel.origin;
    const Range half = 0.5 * smallerSide(texel, zeta - bounds.radius);
    if (error <= half.low) return 0;
    if (error <= half.high) isSeen = Decision::Undecided;
    Decision meets = Decision::Yes;
    const Range depth = leastReceiverDepth(caster, bounds, meets);
    return where(both(isSeen, meets), error * edgePixelsPerUnit_ / greatest(depth, caster.receiverNear));
}

} // namespace gnomon::selection
