// Computes the error in pixels that refining a group of clusters would remove, on the screen or at the edge of a
// shadow. This error rule selects the level of detail.
#pragma once

#include "core/camera.h"
#include "core/convex_volume.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::lod {

/// The view for which detail is selected. Positions are in the model's LOCAL space (world minus the grid's origin).
struct DetailView {
    glm::dvec3 eye{0};
    CameraBasis basis;
    /// Tangents of half the horizontal and half the vertical angle of view, both above 0.
    double tanHalfX = 0.5773502691896257;
    double tanHalfY = 0.5773502691896257;
    double heightPixels = 800;
    // min view depth of visible geometry in world units, above 0; smaller depths are clamped to it
    double nearestDepth = 1e-6;

    /// Returns the number of pixels per unit length perpendicular to the view axis, at view depth 1.
    double pixelsPerUnit() const { return heightPixels / (2 * tanHalfY); }

    /// Returns the displacement of a shadow edge in pixels per unit of the caster's error, at view depth 1, multiplied
    /// by kEdgeMargin.
    double edgePixelsPerUnit() const { return kEdgeMargin * pixelsPerUnit(); }

    /// The factor by which the error rule multiplies the displacement of a shadow edge. The edge moves with the caster.
    /// In addition, the receiver has an error, and its surface is at any angle to the light. The factor was measured on
    /// five models with an error limit of 1 pixel. With the factor 1.2, the displacement of edges is 1.41 pixels at the
    /// 99th percentile. With the factor 1, it is 1.75 pixels (bench/shadow_edges).
    static constexpr double kEdgeMargin = 1.2;
};

/// Returns the view pyramid of `view`: its four side planes, and the plane through the eye perpendicular to the view.
ConvexVolume viewPyramid(const DetailView& view);

/// The size of a shadow map's texel as a function of `zeta`, the distance along the map's t axis (w_lx and w_lz in
/// docs/shadow_theory.md, without shear). `zeta` is dot(axis, point) - origin, clamped to [0, depth]. If all members
/// are 0, there are no texels, because rays compute the shadows.
struct TexelWidth {
    glm::dvec3 axis{0, 0, 1}; // unit vector in local space: z axis of the light's axes
    double origin = 0;        // dot(axis, point) where zeta is 0
    double depth = 0;         // largest zeta (d)
    double kappa = 0;         // strength of the map's perspective warp
    double width = 0;         // W / res_s: width of a texel at zeta = 0
    // d / res_t: length of a texel without a warp; with logarithmic rows, the length at zeta = 0
    double length = 0;
    // true: logarithmic rows, whose length grows in proportion to the width; false: with the square of the width
    bool isLog = false;

    /// Returns the smaller side of the texel at `zeta`, in world units. It grows with zeta.
    double smallerSide(double zeta) const;
};

/// A point light, and its distance to the farthest receiver.
struct PointReach {
    glm::dvec3 at{0}; // local space
    double farthest = 0;
};

/// The casters of one partition (the part of the view with its own shadow map), with the data that determine their
/// level of detail.
struct CasterDetail {
    ConvexVolume casters;             // volume of all casters of the partition, in local space, with unit normals
    ConvexVolume receivers;           // frustum of the partition, or its part within the model's bounds; local space
    double receiverNear = 1e-6;       // min view depth in `receivers`, above 0
    glm::dvec3 towardsLight{0, 1, 0}; // unit, local space
    TexelWidth texel;
    std::optional<PointReach> point; // the point light, if any; replaces towardsLight
};

/// The error rule: converts the bounding sphere and the error of a group of clusters to pixels. The rule is monotone:
/// if one sphere contains another sphere and has at least the same error, it has at least the same number of pixels.
/// Along each chain of refinement, pixels therefore never decrease towards the root. The test "refine if pixels >
/// limit" thus gives a valid cut for each limit.
///
/// Error in view, if the sphere intersects the view pyramid: let e be a displacement at view depth z, whose direction
/// from the eye has the angle phi to the view axis. It moves the image by at most e pixelsPerUnit / (z cos phi). This
/// is the radial stretch 1/cos^2 phi, divided by the distance z / cos phi. The rule uses the smallest z and the largest
/// phi of the sphere. phi is at most the angle of the image corner.
///
/// Error as a caster, in view or not, for each partition whose caster volume intersects the sphere: if the error is at
/// most half a texel at the sphere's shadow, the result is 0. Otherwise it is e edgePixelsPerUnit / z, where z is the
/// smallest view depth of the partition's receivers on the light rays through the sphere. For a point light, the rule
/// assumes receivers at the smallest view depth and at the largest distance from the light, and includes the
/// magnification of the shadow. If the light hits a receiver at the angle a, the real displacement of the edge is 1 /
/// sin a of this value, divided by DetailView::kEdgeMargin.
class ErrorRule {
public:
    /// Creates the error rule of a view without shadows.
    explicit ErrorRule(const DetailView& view);

    /// Creates the error rule of a view and of its shadow casters.
    ErrorRule(const DetailView& view, std::vector<CasterDetail> casters);

    const DetailView& view() const { return view_; }

    std::span<const CasterDetail> casters() const { return casters_; }

    /// Returns the error, in pixels, that refining a group with bounding sphere `bounds` and stored error `error` would
    /// remove: the max of viewPixels and casterPixels. Returns 0 if refining would not be visible, and infinity for an
    /// infinite error (a root group).
    double pixels(const Sphere& bounds, double error) const {
        if (error == std::numeric_limits<double>::infinity()) return error;
        return std::max(viewPixels(bounds, error), casterPixels(bounds, error));
    }

    /// Returns true if pixels(bounds, error) would exceed `threshold`. This function is faster than `pixels`.
    bool exceeds(const Sphere& bounds, double error, double threshold) const {
        return error == std::numeric_limits<double>::infinity() || viewPixels(bounds, error) > threshold ||
               casterPixels(bounds, error, threshold) > threshold;
    }

    /// Returns the screen-space error, in pixels, of geometry in the sphere `bounds` that is displaced by `error`.
    double viewPixels(const Sphere& bounds, double error) const;

    /// Returns a lower bound of the screen-space error `viewPixels` for all spheres that contain a point of `box`
    /// (local space) and have at least the error `error`. Returns 0 if `box` is not completely in view.
    double minViewPixels(const Box& box, double error) const;

    /// Returns an upper bound of the displacement in the image, in pixels, if geometry in `box` (local space) moves by
    /// `error`. Returns 0 if the geometry is not visible. The bound is at most the size of the image in pixels.
    double maxViewPixels(const Box& box, double error) const;

    /// Returns the displacement of shadow edges, in pixels, if casters in the sphere `bounds` are displaced by `error`.
    /// If this displacement is at most `floor`, the function may return any number up to `floor`, which is faster.
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
