#include "viewer/recent/recent_views.h"

#include <cmath>
#include <utility>

namespace gnomon::viewer {

namespace {

bool isElsewhere(const Camera& here, const Camera& camera) {
    constexpr double kSameWay = 0.01;
    constexpr double kSameCosine = 0.99985; // cosine of one degree
    const glm::dvec3 ahead = here.target - here.eye;
    const double cosine = glm::dot(glm::normalize(ahead), glm::normalize(camera.target - camera.eye));
    return camera.projection != here.projection ||
           glm::distance(camera.eye, here.eye) > kSameWay * glm::length(ahead) || cosine < kSameCosine;
}

} // namespace

RecentViews::RecentViews(std::vector<Camera> cameras) : cameras_(std::move(cameras)) {
    if (cameras_.size() > kMaxViews) cameras_.erase(cameras_.begin(), cameras_.end() - kMaxViews);
    if (!cameras_.empty()) at_ = cameras_.size() - 1;
}

void RecentViews::see(const Camera& camera, double seconds) {
    constexpr double kStay = 0.5; // seconds
    if (!seen_ || isElsewhere(*seen_, camera)) {
        seen_ = camera;
        since_ = seconds;
    } else if (seconds - since_ >= kStay) {
        stay(camera);
    }
}

void RecentViews::stay(const Camera& camera) {
    if (!cameras_.empty() && !isElsewhere(cameras_[at_], camera)) return;
    if (!cameras_.empty()) cameras_.resize(at_ + 1);
    if (cameras_.size() == kMaxViews) cameras_.erase(cameras_.begin());
    cameras_.push_back(camera);
    at_ = cameras_.size() - 1;
}

std::optional<Camera> RecentViews::back() {
    if (at_ == 0) return std::nullopt;
    return cameras_[--at_];
}

std::optional<Camera> RecentViews::forth() {
    if (at_ + 1 >= cameras_.size()) return std::nullopt;
    return cameras_[++at_];
}

} // namespace gnomon::viewer
