// The texel plot: a disc that shows the storage factor of a shadow scheme for each light direction of a hemisphere.
// The storage factor is the number of texels per pixel that shadow maps need.
#pragma once

#include "core/camera.h"
#include "shadow/fit/view_frustum.h"
#include "shadow/scheme.h"

#include <optional>
#include <vector>

namespace gnomon::viewer {

/// Maps a hemisphere of light directions to a disc. The centre is the pole (`up` or down), the rim is the horizon, and
/// the upper end is the heading of the camera. The distance from the centre is proportional to the angle from the pole.
struct LightDisc {
    glm::dvec3 up{0, 1, 0};       // unit length
    glm::dvec3 heading{0, 0, -1}; // unit length, perpendicular to `up`: the view direction without its pitch
    bool fromBelow = false;

    /// Returns the unit direction towards the light that the position `point` on the disc represents. x points to the
    /// right and y to the upper end. Points outside the unit circle count as points on it.
    glm::dvec3 direction(const glm::dvec2& point) const;

    /// Returns the position on the disc that represents a light direction; the inverse of `direction`. Directions of
    /// the other hemisphere are outside the rim.
    glm::dvec2 point(const glm::dvec3& towardsLight) const;
};

/// Returns the disc of light directions for a camera: the hemisphere above the horizon, or the one below it if
/// `fromBelow` is true.
LightDisc lightDisc(const Camera& camera, bool fromBelow);

/// The input from which storage factors are computed.
struct TexelPlotInput {
    LightDisc disc;
    CameraBasis basis;
    shadow::ViewFrustum frustum;
    shadow::Scheme scheme;
};

/// Returns the storage factor (texels per pixel that shadow maps need) for a light direction in world space.
double storageFactor(const TexelPlotInput& input, const glm::dvec3& towardsLight);

/// The storage factors of all light directions of a disc, on a square grid. A frame computes only a few of them, so
/// that no frame takes long.
class TexelPlot {
public:
    /// Creates a texel plot with a grid of `side` x `side` cells. `side` is at least 1.
    explicit TexelPlot(int side)
        : side_(side), values_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {}

    int side() const { return side_; }

    /// Starts the computation of the storage factors for `input`. Old values remain visible until new ones replace
    /// them. nullopt stops the computation.
    void ask(const std::optional<TexelPlotInput>& input);

    /// Computes the storage factors of up to `count` more cells.
    void improve(int count);

    /// Returns true if the storage factors of all cells are computed.
    bool isComplete() const { return !input_ || next_ == values_.size(); }

    /// Returns the storage factor of a cell, by column and row from the lower left. Returns nullopt outside the disc or
    /// before the computation.
    std::optional<double> at(int column, int row) const { return values_[index(column, row)]; }

    /// Returns the centre of a cell of the grid, in coordinates from -1 to 1 over the disc.
    glm::dvec2 middle(int column, int row) const;

    /// The min and max of the storage factors that are computed so far.
    struct Range {
        double min = 0;
        double max = 0;
    };

    std::optional<Range> range() const;

private:
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(column);
    }

    int side_;
    std::optional<TexelPlotInput> input_;
    std::size_t next_ = 0; // number of processed cells
    std::vector<std::optional<double>> values_;
};

} // namespace gnomon::viewer
