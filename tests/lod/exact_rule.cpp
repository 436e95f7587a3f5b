#include "exact_rule.h"

#include <array>
#include <optional>

namespace gnomon::tests {

namespace {

using lod::CasterDetail;
using lod::DetailView;
using lod::TexelWidth;
using theory::greater;
using theory::lesser;
using theory::Real;

struct Vector {
    Real x, y, z;

    Vector(Real a, Real b, Real c) : x(std::move(a)), y(std::move(b)), z(std::move(c)) {}

    Vector(const glm::dvec3& v) : x(v.x), y(v.y), z(v.z) {} // NOLINT(google-explicit-constructor)
};

Real dot(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

Real length(const Vector& v) {
    return root(dot(v, v));
}

bool touches(const ConvexVolume& volume, const Sphere& sphere) {
    for (const Plane& plane : volume.planes)
        if (dot(plane.normal, sphere.center) + plane.offset < Real(-sphere.radius)) return false;
    return true;
}

/// Whether the sphere comes to the inner side of the plane through the eye along `scale` times the view plus `across`.
bool isBefore(const DetailView& view, double scale, const glm::dvec3& across, const Sphere& sphere) {
    const glm::dvec3& v = view.basis.view;
    const Vector inward{Real(v.x) * scale + across.x, Real(v.y) * scale + across.y, Real(v.z) * scale + across.z};
    return dot(inward, Vector(sphere.center) - view.eye) >= Real(-sphere.radius) * length(inward);
}

bool isInView(const DetailView& view, const Sphere& sphere) {
    const CameraBasis& basis = view.basis;
    return isBefore(view, view.tanHalfX, basis.right, sphere) && isBefore(view, view.tanHalfX, -basis.right, sphere) &&
           isBefore(view, view.tanHalfY, basis.up, sphere) && isBefore(view, view.tanHalfY, -basis.up, sphere) &&
           isBefore(view, 1, glm::dvec3(0), sphere);
}

Real perUnit(const DetailView& view) {
    return Real(view.heightPixels) / (Real(2) * view.tanHalfY);
}

Real viewPixels(const DetailView& view, const Sphere& sphere, double error) {
    if (!isInView(view, sphere)) return 0;
    const Vector toCenter = Vector(sphere.center) - view.eye;
    const Real depth = dot(toCenter, view.basis.view);
    const Real distance = length(toCenter);
    Real cosine = Real(1) / root(Real(1) + Real(view.tanHalfX) * view.tanHalfX + Real(view.tanHalfY) * view.tanHalfY);
    if (depth > Real(0) && distance > Real(sphere.radius)) {
        const Real cosAxis = depth / distance;
        const Real sinCone = Real(sphere.radius) / distance;
        const Real sinAxis = root(greater(Real(0), Real(1) - cosAxis * cosAxis));
        cosine = greater(cosine, cosAxis * root(Real(1) - sinCone * sinCone) - sinAxis * sinCone);
    }
    return Real(error) * perUnit(view) / (greater(depth - sphere.radius, view.nearestDepth) * cosine);
}

Real smallerSide(const TexelWidth& texel, const Real& zeta) {
    const Real stretch = Real(1) + Real(texel.kappa) * greater(Real(0), lesser(zeta, texel.depth));
    const Real length = Real(texel.length) * stretch;
    const Real along = texel.isLog ? length : length * stretch / (Real(1) + Real(texel.kappa) * texel.depth);
    return lesser(Real(texel.width) * stretch, along);
}

/// The least view depth of what the light through the sphere's centre meets of the grown receivers.
std::optional<Real> minDepth(const CasterDetail& caster, const DetailView& view, const Sphere& sphere) {
    const Vector direction(-caster.towardsLight);
    Real first = 0;
    std::optional<Real> last;
    for (const Plane& plane : caster.receivers.planes) {
        const Real start = dot(plane.normal, sphere.center) + plane.offset + sphere.radius;
        const Real slope = dot(plane.normal, direction);
        if (slope == Real(0)) {
            if (start < Real(0)) return std::nullopt;
            continue;
        }
        const Real end = -start / slope;
        if (slope > Real(0))
            first = greater(first, end);
        else
            last = last ? lesser(*last, end) : end;
    }
    if (last && *last < first) return std::nullopt;
    const Real start = dot(Vector(sphere.center) - view.eye, view.basis.view);
    const Real slope = dot(direction, view.basis.view);
    if (slope >= Real(0)) return start + slope * first;
    return last ? start + slope * *last : Real(-1e300);
}

Real casterPixels(const CasterDetail& caster, const DetailView& view, const Sphere& sphere, double error) {
    if (!touches(caster.casters, sphere)) return 0;
    const Real unit = Real(error) * DetailView::kEdgeMargin * perUnit(view);
    if (caster.point) {
        const Real farthest = caster.point->farthest;
        const Real from = length(Vector(sphere.center) - caster.point->at) - sphere.radius;
        return unit * greater(Real(1), farthest / greater(from, Real(1e-6) * farthest)) / caster.receiverNear;
    }
    const Real zeta = dot(caster.texel.axis, sphere.center) - caster.texel.origin;
    if (Real(2) * error <= smallerSide(caster.texel, zeta - sphere.radius)) return 0;
    const std::optional<Real> depth = minDepth(caster, view, sphere);
    return depth ? unit / greater(*depth - sphere.radius, caster.receiverNear) : Real(0);
}

} // namespace

Real exactPixels(const lod::ErrorRule& rule, const Sphere& bounds, double error) {
    Real result = viewPixels(rule.view(), bounds, error);
    for (const CasterDetail& caster : rule.casters())
        result = greater(result, casterPixels(caster, rule.view(), bounds, error));
    return result;
}

} // namespace gnomon::tests
