// The recent views of the user: cameras that did not move for half a second. The user can go back and forward through
// them.
#pragma once

#include "core/camera.h"

#include <optional>
#include <vector>

namespace gnomon::viewer {

/// The last views of one model, oldest first, and the index of the current one.
class RecentViews {
public:
    RecentViews() = default;

    /// Starts with stored cameras, oldest first. Only the last kMaxViews of them are used.
    explicit RecentViews(std::vector<Camera> cameras);

    /// Returns the cameras of all recent views, oldest first.
    const std::vector<Camera>& cameras() const { return cameras_; }

    /// Updates the views with the camera at the time `seconds` of any clock. A camera that has not moved for half a
    /// second becomes a recent view.
    void see(const Camera& camera, double seconds);

    /// Adds a view, unless it is almost equal to the current one: within a hundredth of the distance to its target, and
    /// one degree. All views after the current one are removed. The oldest one is removed if there are more than
    /// kMaxViews.
    void stay(const Camera& camera);

    /// Returns the camera of the previous view, which becomes the current one. Returns nullopt at the first view.
    std::optional<Camera> back();

    /// Returns the camera of the next view, which becomes the current one. Returns nullopt at the last view.
    std::optional<Camera> forth();

    static constexpr std::size_t kMaxViews = 100;

private:
    std::vector<Camera> cameras_;
    std::size_t at_ = 0;         // index of the current camera, if any
    std::optional<Camera> seen_; // last camera at a different place
    double since_ = 0;           // time of its first appearance
};

} // namespace gnomon::viewer
