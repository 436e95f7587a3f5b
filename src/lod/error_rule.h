// The error rule: the error in pixels that the refinement of a group would remove, on the screen or at a shadow edge.
#pragma once

#include "core/camera.h"
#include "core/convex_volume.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::lod {

/// The view that determines the detail. Positions are LOCAL to the model (world minus the grid's origin).
struct DetailView {
    glm::dvec3 eye{0};
    CameraBasis basis;
    /// Tangents of half the horizontal and half the vertical angle, both above 0.
    double tanHalfX = 0.5773502691896257;
    double tanHalfY = 0.5773502691896257;
    double heightPixels = 800;
    double nearestDepth = 1e-6; // min depth of geometry, world units, above 0; nearer geometry counts as this depth

    /// Returns the pixels per unit length perpendicular to the view axis, at view depth 1.
    double pixelsPerUnit() const { return heightPixels / (2 * tanHalfY); }

    /// Returns the pixels per unit of a caster's error that the rule counts for its shadow edge, at view depth 1.
    double edgePixelsPerUnit() const { return kEdgeMargin * pixelsPerUnit(); }

    /// The factor for the displacement of a shadow edge. The edge moves with the caster, but the receiver also has an
    /// error and lies at any angle to the light. The factor was measured on five models: with 1.2 and an error of 1
    /// pixel, the edges are off by 1.41 pixels at the 99th percentile, and with 1 by 1.75 pixels (bench/shadow_edges).
    static constexpr double kEdgeMargin = 1.2;
};

/// Returns the view pyramid of `view`: the four side planes, and the plane through the eye.
ConvexVolume viewPyramid(const DetailView& view);

/// The size of a shadow map's texel as a function of `zeta`, for a perspective warp (w_lx and w_lz of the theory,
/// without shear). `zeta` is dot(axis, point) - origin, clamped to [0, depth]. If all members are 0, the map has no
/// texels: shadows by rays.
struct TexelWidth {
    glm::dvec3 axis{0, 0, 1}; // unit, local space: z axis of the light frame
    double origin = 0;        // dot(axis, point) at zeta = 0
    double depth = 0;         // d
    double kappa = 0;         // of the warp
    double width = 0;         // W / res_s: width at zeta = 0
    double length = 0;        // d / res_t: length without a warp; with logarithmic rows the length at zeta = 0
    bool isLog = false;       // logarithmic rows: the length grows like the width; otherwise with its square

    /// Returns the smaller side of the texel at `zeta`, in world units. It grows with zeta.
    double smallerSide(double zeta) const;
};

/// A point light, and the distance of the farthest receiver from it.
struct PointReach {
    glm::dvec3 at{0}; // local space
    double farthest = 0;
};

/// The required detail of the casters of one partition.
struct CasterDetail {
    ConvexVolume casters;             // volume of all casters of the partition; unit normals, local space
    ConvexVolume receivers;           // the partition's frustum, or the part that the model reaches; local space
    double receiverNear = 1e-6;       // min view depth in `receivers`, above 0
    glm::dvec3 towardsLight{0, 1, 0}; // unit, local space
    TexelWidth texel;
    std::optional<PointReach> point; // replaces towardsLight
};

/// The error in pixels, a monotone function of (bounds, error): a sphere inside another sphere, with an error that is
/// not larger, never has more pixels. Along each chain of refinement, pixels therefore never decrease towards the root.
/// The rule "refine if pixels > threshold" is thus a valid cut for each threshold.
///
/// In view (the sphere intersects the view pyramid): let e be a displacement at view depth z, seen at the angle phi to
/// the view axis. It moves the image by at most e pixelsPerUnit / (z cos phi). This is the radial stretch 1/cos^2 phi
/// over the distance z / cos phi. The rule uses the smallest z and the largest phi of the sphere. phi is limited to the
/// angle of the image corner.
///
/// As a caster, in view or not, for each partition whose caster volume it intersects: the result is 0 if the error is
/// at most half a texel at the sphere's shadow. Otherwise it is e edgePixelsPerUnit / z, where z is the smallest view
/// depth of the partition's receivers on the light rays through the sphere. For a point light, the rule assumes
/// receivers at the smallest view depth and at the largest distance from the light, and includes the magnification of
/// the shadow. If the light hits the receivers at an angle a, the actual displacement of the edge is 1 / sin a of this
/// value, divided by DetailView::kEdgeMargin.
class ErrorRule {
public:
    /// Creates the rule of a view without shadows.
    explicit ErrorRule(const DetailView& view);

    /// Creates the rule of a view and of the casters of its partitions.
    ErrorRule(const DetailView& view, std::vector<CasterDetail> casters);

    const DetailView& view() const { return view_; }

    std::span<const CasterDetail> casters() const { return casters_; }

    /// Returns the larger of viewPixels and casterPixels. Returns 0 if a refinement would not be visible, and infinity
    /// for an infinite error (a root group).
    double pixels(const Sphere& bounds, double error) const {
        if (error == std::numeric_limits<double>::infinity()) return error;
        return std::max(viewPixels(bounds, error), casterPixels(bounds, error));
    }

    /// Returns true if `pixels` is above `threshold`. It is faster than `pixels`.
    bool exceeds(const Sphere& bounds, double error, double threshold) const {
        return error == std::numeric_limits<double>::infinity() || viewPixels(bounds, error) > threshold ||
               casterPixels(bounds, error, threshold) > threshold;
    }

    /// Returns the error in view, in pixels.
    double viewPixels(const Sphere& bounds, double error) const;

    /// Returns a lower bound of `viewPixels` for each sphere that contains a point of `box` (local space), with at
    /// least `error`. Returns 0 if `box` is not completely in view.
    double minViewPixels(const Box& box, double error) const;

    /// Returns an upper bound of the image displacement of geometry in `box` (local space) that moves by `error`.
    /// Returns 0 if the geometry is not visible. The displacement is limited to the size of the image.
    double maxViewPixels(const Box& box, double error) const;

    /// Returns the error at shadow edges, in pixels. If the error is at most `floor`, the result may be any number up
    /// to `floor`.
    double casterPixels(const Sphere& bounds, double error, double floor = 0) const;

private:
    double oneCasterPixels(const CasterDetail& caster, const Sphere& bounds, double error) const;

    DetailView view_;
    ConvexVolume pyramid_;
    double pixelsPerUnit_;
    double edgePixelsPerUnit_;
    double cornerCosine_;
    std::vector<CasterDetail> casters_;
};

} // namespace gnomon::lod
