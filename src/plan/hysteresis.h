// The thresholds of the hysteresis between the plans of consecutive frames: the min number of frames and the min gain
// before a plan changes. The speed limit for the rotation of a map about the light is in shadow/warp/orientation.h.
#pragma once

namespace gnomon::plan {

/// Number of consecutive frames that must permit a higher near depth before near rises. The same number of frames must
/// permit a lower far depth of stabilised slices before far falls. Near falls and far rises at once.
inline constexpr int kFramesBeforeNearRises = 12;

/// Number of frames over which the planning collects the receivers of each slice. At the end of such a period, the maps
/// of all slices without receivers during the period are removed at once. A receiver in a slice without a map starts a
/// new period.
inline constexpr int kFramesBeforeMapsGo = 96;

/// Number of consecutive frames in which another scheme must dominate the scheme of the previous frame before it
/// replaces that scheme. If the old scheme exceeds the max aliasing and another scheme does not, the replacement is
/// immediate.
inline constexpr int kFramesBeforeSchemeGoes = 96;

/// A scheme dominates another scheme if its cost is below this share of the other scheme's cost.
inline constexpr double kCheaper = 0.75;

/// If all schemes exceed the max aliasing, a scheme dominates another scheme if its aliasing bound is below this share
/// of the other scheme's bound.
inline constexpr double kLower = 0.85;

/// An effect, such as face partitions, is used if it multiplies the aliasing bound by at most this factor.
inline constexpr double kWorthwhile = 0.95;

/// An effect of the previous frame stays in use if it multiplies the aliasing bound by at most this factor.
inline constexpr double kStillWorthwhile = 0.99;

/// Limits of a continuous motion between two views. A larger change is a camera cut, which clears all memory between
/// frames (plan/camera_cut.h). kCutShare limits the movement of the eye, as a share of the largest visible depth.
/// kCutDegrees limits the rotation of the view direction, of the up direction and of the light. kCutZoom limits the
/// ratio of the image scales.
inline constexpr double kCutShare = 0.25;
inline constexpr double kCutDegrees = 30;
inline constexpr double kCutZoom = 1.25;

} // namespace gnomon::plan
