// The error rule: how many pixels of error it would remove to refine a group, on the screen or at a shadow's edge.
#pragma once

#include "core/camera.h"
#include "core/convex_volume.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::selection {

/// The view for which detail is chosen. Positions are LOCAL to the model (world minus the grid's origin).
struct DetailView {
    glm::dvec3 eye{0};
    CameraBasis basis;
    double tanHalfX = 0.5773502691896257; // tan of half the horizontal and half the vertical angle, both above 0
    double tanHalfY = 0.5773502691896257;
    double heightPixels = 800;
    double nearestDepth = 1e-6; // nothing counts as nearer than this, world units, above 0

    /// Pixels that a unit length across the view axis covers at view depth 1.
    double pixelsPerUnit() const { return heightPixels / (2 * tanHalfY); }

    /// Pixels that a shadow's edge at view depth 1 is charged for a unit length that what casts it may be off.
    double edgePixelsPerUnit() const { return kEdgeMargin * pixelsPerUnit(); }

    /// An edge moves as what casts it does, but what it falls on is drawn with an error, too, and lies at any angle to
    /// the light. Found by measuring: with 1.2 the edges of five models are 1.41 pixels off at the 99th percentile for
    /// an error of 1 pixel, with 1 they are 1.75 (bench/shadow_edges).
    static constexpr double kEdgeMargin = 1.2;
};

/// The pyramid of what the image of `view` can show: the sides, and the plane of the eye.
ConvexVolume viewPyramid(const DetailView& view);

/// The width of a shadow map's texel, as an affine warp of `zeta` gives it (theory: w_lx and w_lz, without shear).
/// `zeta` is dot(axis, point) - origin, clamped to [0, depth]. All zero is a map without texels: rays.
struct TexelWidth {
    glm::dvec3 axis{0, 0, 1}; // unit, local space: z_l of the light frame
    double origin = 0;        // dot(axis, point) where zeta is 0
    double depth = 0;         // d
    double kappa = 0;         // of the warp
    double width = 0;         // W / res_s: across, at zeta 0
    double length = 0;        // along: d / res_t, without a warp; of logarithmic rows at zeta 0
    bool isLog = false;       // logarithmic rows: the length grows as the width does, else with its square

    /// The smaller side of the texel at `zeta`, world units. It grows with zeta.
    double smallerSide(double zeta) const;
};

/// A point light in place of a direction, and the distance of the farthest receiver from it.
struct PointReach {
    glm::dvec3 at{0}; // local space
    double farthest = 0;
};

/// What a caster of one partition must be exact enough for.
struct CasterDetail {
    ConvexVolume casters;             // all that can throw a shadow into the partition; unit normals, local space
    ConvexVolume receivers;           // the partition's frustum, or what of it the model reaches; local space
    double receiverNear = 1e-6;       // the least view depth in `receivers`, above 0
    glm::dvec3 towardsLight{0, 1, 0}; // unit, local space
    TexelWidth texel;
    std::optional<PointReach> point; // in place of towardsLight
};

/// Pixels of error as a monotone function of (bounds, error): a sphere within another, with an error no larger, never
/// gets more pixels. So along every chain of refinement pixels never decrease towards the root, and
/// "refined where pixels > threshold" is a valid cut for any threshold.
///
/// In view (the sphere touches the pyramid): a displacement e at view depth z, seen phi off the view axis, moves its
/// image by at most e pixelsPerUnit / (z cos phi), which is the radial stretch 1/cos^2 phi over the distance z / cos
/// phi. The rule takes the least z and the largest phi that the sphere reaches, each no further than the image's
/// corner, so corners are not under-reported and the centre is not charged for them.
///
/// As a caster, in view or not, for each partition whose caster volume it touches: nothing if the error is at most half
/// a texel where the sphere's shadow falls, else e edgePixelsPerUnit / z at the least view depth z of the partition's
/// receivers on the light rays through the sphere; from a point light what that is where all receivers are as near as
/// the nearest and as far from the light as the farthest, whose shadows the light throws so much larger. Where the
/// light meets these at an angle a, the edge moves by 1 / sin a of that over DetailView::kEdgeMargin.
class ErrorRule {
public:
    /// The rule of a view that casts no shadows.
    explicit ErrorRule(const DetailView& view);

    /// The rule of a view and of the casters of its partitions.
    ErrorRule(const DetailView& view, std::vector<CasterDetail> casters);

    const DetailView& view() const { return view_; }

    std::span<const CasterDetail> casters() const { return casters_; }

    /// The larger of both; 0 where refining would be seen nowhere, infinite for an infinite error (a root group).
    double pixels(const Sphere& bounds, double error) const {
        if (error == std::numeric_limits<double>::infinity()) return error;
        return std::max(viewPixels(bounds, error), casterPixels(bounds, error));
    }

    /// Whether `pixels` is above `threshold`, found with less work.
    bool exceeds(const Sphere& bounds, double error, double threshold) const {
        return error == std::numeric_limits<double>::infinity() || viewPixels(bounds, error) > threshold ||
               casterPixels(bounds, error, threshold) > threshold;
    }

    /// The part that the screen shows.
    double viewPixels(const Sphere& bounds, double error) const;

    /// No more than `viewPixels` gives any sphere that encloses something in `box` (local space), with `error` or more;
    /// 0 where `box` does not lie in view as a whole.
    double leastViewPixels(const Box& box, double error) const;

    /// What `viewPixels` bounds by a sphere, of what lies in `box` (local space): no less than the image of anything
    /// there moves with a displacement of `error`, 0 where that shows nothing. No image moves further than across the
    /// picture.
    double mostViewPixels(const Box& box, double error) const;

    /// The part that shows at the edges of shadows; any number up to `floor` if it is not more.
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

} // namespace gnomon::selection
