// The number of directions of light over which an image is averaged. Images with visible penumbrae sample the sun's
// disc. Images in which geometry hides a part of the sky sample the sky.
#pragma once

#include "core/words.h"
#include "shadow/image_tiles.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::plan {

/// The distribution of brightness over the sky. Uniform has the same brightness everywhere. Overcast is the CIE
/// standard overcast sky, three times as bright at the zenith as at the horizon (Moon, Spencer 1942). A level surface
/// that sees the whole sky receives the same light from both.
enum class SkyModel : std::uint8_t { Uniform, Overcast };
inline constexpr std::array kSkyModels = {
    Word<SkyModel>{SkyModel::Uniform, "uniform"},
    Word<SkyModel>{SkyModel::Overcast, "overcast"},
};

/// The sampling of the sky's light. With 0 directions, geometry does not occlude the sky.
struct SkyLight {
    int directions = 0;
    SkyModel model = SkyModel::Uniform;

    bool operator==(const SkyLight&) const = default;
};

/// The penumbrae of a plan.
struct Penumbra {
    double widestPixels = 0; // upper bound of the penumbra widths in view, in pixels perpendicular to the beam
    double minPixels = 0;    // narrower penumbrae are drawn as if the light were a point
    int directions = 1;      // samples of the light's disc; 1: the light is a point
    /// The tiles that can contain penumbrae of at least minPixels, if there is more than one direction. Null means
    /// all tiles.
    std::shared_ptr<const shadow::TileMask> tiles{};
};

/// Upper bounds of the penumbra widths, one per tile of an image, in pixels perpendicular to the beam. If `byTile` is
/// empty, `widest` is the bound for the whole image.
struct PenumbraBound {
    double widest = 0;
    shadow::ImageTiles tiles;
    std::span<const double> byTile{};
};

struct FramePlan;

/// Sets `plan.penumbra` for penumbrae that are at most as wide as `bound`. `plan` must have its view and quality. Adds
/// an entry to `plan.omitted` if the light is drawn as a point.
void planPenumbra(FramePlan& plan, const PenumbraBound& bound);

/// Sets `plan.sky`, or adds an entry to `plan.omitted`. `isAnythingHidden` is true if geometry may lie between a
/// visible surface and the sky.
void planSky(FramePlan& plan, bool isAnythingHidden);

/// Removes penumbrae and sky light from `plan`. Call this if the finished image has no sun.
void skipLightSampling(FramePlan& plan);

/// Returns the number of frames of an image in which each frame has its own direction of light. Returns 1 if the light
/// needs only one frame.
int lightFrames(const FramePlan& plan);

} // namespace gnomon::plan
