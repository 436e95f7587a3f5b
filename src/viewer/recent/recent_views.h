// The cameras at which a person stayed, to go back to and forth again.
#pragma once

#include "core/camera.h"

#include <optional>
#include <vector>

namespace gnomon::viewer {

/// The last cameras of one model, oldest first, and which of them is the one at hand.
class RecentViews {
public:
    RecentViews() = default;

    /// As they were kept, oldest first; of more than kMost the last.
    explicit RecentViews(std::vector<Camera> cameras);

    /// All of them, oldest first.
    const std::vector<Camera>& cameras() const { return cameras_; }

    /// Takes in where the camera is at a time, seconds on any clock: where it has not moved for half a second, it
    /// stays.
    void see(const Camera& camera, double seconds);

    /// Keeps a camera, unless it is that at hand but for a hundredth of the way to its target and a degree. What lay
    /// ahead is forgotten then, and of more than kMost the oldest.
    void stay(const Camera& camera);

    /// The camera before that at hand, which is at hand from now on; nothing at the first.
    std::optional<Camera> back();

    /// The camera behind it, likewise.
    std::optional<Camera> forth();

    static constexpr std::size_t kMost = 100;

private:
    std::vector<Camera> cameras_;
    std::size_t at_ = 0;         // of the one at hand, if there is any
    std::optional<Camera> seen_; // the last that was elsewhere
    double since_ = 0;           // when it was first seen
};

} // namespace gnomon::viewer
