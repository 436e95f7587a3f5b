// The recent views of the user: cameras that rested for a while, with back and forward.
#pragma once

#include "core/camera.h"

#include <optional>
#include <vector>

namespace gnomon::viewer {

/// The last cameras of one model, oldest first, and the index of the current one.
class RecentViews {
public:
    RecentViews() = default;

    /// Takes stored cameras, oldest first. It uses the last kMaxViews of them.
    explicit RecentViews(std::vector<Camera> cameras);

    /// Returns all cameras, oldest first.
    const std::vector<Camera>& cameras() const { return cameras_; }

    /// Processes the camera at a time (seconds on any clock). Adds the camera if it has rested for half a second.
    void see(const Camera& camera, double seconds);

    /// Adds a camera, unless it is almost equal to the current one: within a hundredth of the distance to its target,
    /// and one degree. The views after the current one are removed, and the oldest one if there are more than
    /// kMaxViews.
    void stay(const Camera& camera);

    /// Returns the previous camera, which becomes the current one. Returns nothing at the first camera.
    std::optional<Camera> back();

    /// Returns the next camera, which becomes the current one. Returns nothing at the last camera.
    std::optional<Camera> forth();

    static constexpr std::size_t kMaxViews = 100;

private:
    std::vector<Camera> cameras_;
    std::size_t at_ = 0;         // index of the current camera, if any
    std::optional<Camera> seen_; // last camera at a different place
    double since_ = 0;           // time of its first appearance
};

} // namespace gnomon::viewer
