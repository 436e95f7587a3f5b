// Every threshold that keeps a plan steady from frame to frame: for how long, and by how much, before something
// changes. (How fast a map may roll about the light is shadow's: shadow/warp/orientation.h.)
#pragma once

namespace gnomon::plan {

/// How many frames in a row must allow a higher near, or with stabilised slices a lower far, before it moves there. The
/// other way it moves at once.
inline constexpr int kFramesBeforeNearRises = 12;

/// The frames after which the slices that have been empty all the while lose their maps, all at once. A receiver in a
/// slice without a map begins them anew.
inline constexpr int kFramesBeforeMapsGo = 96;

/// How many frames in a row another scheme must dominate before it takes the place of that of the frame before; a
/// promise that would be broken waits for nothing.
inline constexpr int kFramesBeforeSchemeGoes = 96;

/// A scheme dominates another scheme if it costs less than this share of the other scheme's cost.
inline constexpr double kCheaper = 0.75;

/// And, where none keeps what was asked, promises less than this share of what the other promises.
inline constexpr double kLower = 0.85;

/// An effect has to lower the promise to this share of what it is without it.
inline constexpr double kWorthwhile = 0.95;

/// And is kept from frame to frame while it lowers it to this share.
inline constexpr double kStillWorthwhile = 0.99;

/// Views one after the other that differ by more than one of these are no motion but a jump, behind which nothing is
/// kept (plan/view_jump.h): the way of the eye, as a share of the farthest depth that was seen; the turn of the view,
/// of what is up in it, or of the light; and the factor between the sizes at which things are seen.
inline constexpr double kJumpShare = 0.25;
inline constexpr double kJumpDegrees = 30;
inline constexpr double kJumpZoom = 1.25;

} // namespace gnomon::plan
