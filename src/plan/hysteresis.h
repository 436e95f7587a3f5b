// Thresholds that prevent flicker between the plans of consecutive frames: the min number of frames and the min gain
// before a plan changes. The speed limit for the rotation of a map about the light is in shadow/warp/orientation.h.
#pragma once

namespace gnomon::plan {

/// Number of consecutive frames that must permit a higher near depth before the near depth rises. The far depth of
/// stabilised slices falls only after the same number of frames. The near depth falls at once, and the far depth rises
/// at once.
inline constexpr int kFramesBeforeNearRises = 12;

/// Number of frames over which the planning collects the receivers of each slice. At the end of such a period, all
/// slices without receivers during the period lose their shadow maps at once. A receiver in a slice without a map
/// starts a new period.
inline constexpr int kFramesBeforeMapsGo = 96;

/// Number of consecutive frames in which another shadow scheme must dominate the current scheme before it replaces the
/// current scheme. If the current scheme exceeds the max aliasing and another scheme does not, the replacement is
/// immediate.
inline constexpr int kFramesBeforeSchemeGoes = 96;

/// A shadow scheme dominates another scheme if its cost is below this fraction of the other cost.
inline constexpr double kCheaper = 0.75;

/// If all shadow schemes exceed the max aliasing, a scheme dominates another scheme if its aliasing bound is below this
/// fraction of the other bound.
inline constexpr double kLower = 0.85;

/// A new effect, such as face partitions, is used only if it multiplies the aliasing bound by at most this factor.
inline constexpr double kWorthwhile = 0.95;

/// An effect that the previous frame used stays in use if it multiplies the aliasing bound by at most this factor.
inline constexpr double kStillWorthwhile = 0.99;

/// Limits of a continuous camera motion between two views. A larger change clears all hysteresis values
/// (plan/camera_cut.h). kCutShare limits the movement of the eye, as a fraction of the largest visible depth.
/// kCutDegrees limits the rotation of the view direction, of the up direction and of the light. kCutZoom limits the
/// ratio of the image scales.
inline constexpr double kCutShare = 0.25;
inline constexpr double kCutDegrees = 30;
inline constexpr double kCutZoom = 1.25;

} // namespace gnomon::plan
