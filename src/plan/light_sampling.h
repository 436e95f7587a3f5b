// The number of light directions over which an image is averaged. Images with visible penumbrae sample the sun's disc.
// Images in which geometry hides a part of the sky sample the sky.
#pragma once

#include "core/words.h"
#include "shadow/image_tiles.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::plan {

/// The distribution of brightness over the sky. Uniform has the same brightness everywhere. Overcast is the CIE
/// standard overcast sky, three times as bright at the zenith as at the horizon (Moon, Spencer 1942). A horizontal
/// surface that sees the whole sky receives the same light from both models.
enum class SkyModel : std::uint8_t { Uniform, Overcast };
inline constexpr std::array kSkyModels = {
    Word<SkyModel>{SkyModel::Uniform, "uniform"},
    Word<SkyModel>{SkyModel::Overcast, "overcast"},
};

/// The sampling of the sky's light. With 0 directions, geometry does not occlude the light of the sky.
struct SkyLight {
    int directions = 0;
    SkyModel model = SkyModel::Uniform;

    bool operator==(const SkyLight&) const = default;
};

/// The penumbrae in the image of a plan.
struct Penumbra {
    double widestPixels = 0; // upper bound of the penumbra widths in view, in pixels perpendicular to the beam
    double minPixels = 0;    // narrower penumbrae are drawn as if the light were a point
    int directions = 1;      // samples of the light's disc; 1: the light is a point
    /// The tiles that can contain penumbrae of at least `minPixels`. Null means all tiles. Set only if there is more
    /// than one direction.
    std::shared_ptr<const shadow::TileMask> tiles{};
};

/// Upper bounds of the penumbra widths per image tile, in pixels perpendicular to the beam. If `byTile` is empty,
/// `widest` is the bound for the whole image.
struct PenumbraBound {
    double widest = 0;
    shadow::ImageTiles tiles;
    std::span<const double> byTile{};
};

struct FramePlan;

/// Sets `plan.penumbra` for penumbrae whose widths are at most `bound`. `plan` must have its view and quality. If the
/// light is drawn as a point, adds the reason to `plan.omitted`.
void planPenumbra(FramePlan& plan, const PenumbraBound& bound);

/// Sets `plan.sky`, or adds the reason for its absence to `plan.omitted`. `isAnythingHidden` is true if geometry may
/// lie between a visible surface and the sky.
void planSky(FramePlan& plan, bool isAnythingHidden);

/// Removes penumbrae and sky light from `plan`. Call this function if the image is drawn without the sun.
void skipLightSampling(FramePlan& plan);

/// Returns the number of frames that the planned light directions require: each frame of an accumulated image has its
/// own direction. Returns 1 if one frame suffices.
int lightFrames(const FramePlan& plan);

} // namespace gnomon::plan
