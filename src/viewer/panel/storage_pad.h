// The hemisphere of lights as a disc, and the storage factor of a scheme for each of them.
#pragma once

#include "core/camera.h"
#include "shadow/fit/view_frustum.h"
#include "shadow/scheme.h"

#include <optional>
#include <vector>

namespace gnomon::viewer {

/// The disc: its middle is the pole (`up`, or down), its rim the horizon, its upper end where the camera heads. Angles
/// from the pole are even along a radius.
struct LightDisc {
    glm::dvec3 up{0, 1, 0};       // unit
    glm::dvec3 heading{0, 0, -1}; // unit, across `up`: the way the camera looks, without its pitch
    bool fromBelow = false;

    /// Unit direction towards the light at `point`, x to the right and y to the upper end, within the unit circle;
    /// points beyond it count as on it.
    glm::dvec3 direction(const glm::dvec2& point) const;

    /// The inverse; directions of the other hemisphere lie beyond the rim.
    glm::dvec2 point(const glm::dvec3& towardsLight) const;
};

/// The disc of a camera.
LightDisc lightDisc(const Camera& camera, bool fromBelow);

/// What storage is asked for.
struct StorageQuestion {
    LightDisc disc;
    CameraBasis basis;
    shadow::ViewFrustum frustum;
    shadow::Scheme scheme;
};

/// The storage factor for a light, world space.
double storageFactor(const StorageQuestion& question, const glm::dvec3& towardsLight);

/// The storage factors over the disc on a square grid, found a few at a time so that no frame waits for them.
class StoragePad {
public:
    /// `side` cells a side, at least 1.
    explicit StoragePad(int side)
        : side_(side), values_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {}

    int side() const { return side_; }

    /// Asks anew if `question` is not the one at hand; old values stay until new ones replace them. Nothing: asks no
    /// more.
    void ask(const std::optional<StorageQuestion>& question);

    /// Finds up to `count` more.
    void improve(int count);

    /// Whether all are found that were asked for.
    bool isComplete() const { return !question_ || next_ == values_.size(); }

    /// The factor in a cell, column and row from the lower left; nothing outside the disc or not found yet.
    std::optional<double> at(int column, int row) const { return values_[index(column, row)]; }

    /// The middle of a cell in the unit circle's square.
    glm::dvec2 middle(int column, int row) const;

    /// The least and the largest found so far; nothing before the first.
    struct Range {
        double least = 0;
        double largest = 0;
    };

    std::optional<Range> range() const;

private:
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(column);
    }

    int side_;
    std::optional<StorageQuestion> question_;
    std::size_t next_ = 0; // cells asked so far
    std::vector<std::optional<double>> values_;
};

} // namespace gnomon::viewer
