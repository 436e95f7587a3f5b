// Plans the number of light directions over which an image is averaged. Images with visible penumbrae sample the sun's
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
/// standard overcast sky, three times as bright at the zenith as at the horizon (Moon, Spencer 1942). A horizontal
/// surface that sees the whole sky receives the same light from both models.
enum class SkyModel : std::uint8_t { Uniform, Overcast };
inline constexpr std::array kSkyModels = {
    Word<SkyModel>{SkyModel::Uniform, "uniform"},
    Word<SkyModel>{SkyModel::Overcast, "overcast"},
};

/// The number of sky directions that light an image. With 0 directions, geometry does not occlude the light of the sky.
struct SkyLight {
    int directions = 0;
    SkyModel model = SkyModel::Uniform;

    bool operator==(const SkyLight&) const = default;
};

/// How an image samples the sun's disc to draw penumbrae.
struct Penumbra {
    double widestPixels = 0; // upper bound of the penumbra widths in view, in pixels perpendicular to the beam
    double minPixels = 0;    // narrower penumbrae are drawn as if the light were a point
    int directions = 1;      // samples of the light's disc; 1: the light is a point
    /// The image tiles that can contain penumbrae of at least `minPixels`. Null means all tiles. Set only if there is
    /// more than one light direction.
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

/// Chooses the number of light directions for penumbrae whose widths are at most `bound`, and sets `plan.penumbra`.
/// `plan` must have its view and quality. If the light is drawn as a point, adds the reason to `plan.omitted`.
void planPenumbra(FramePlan& plan, const PenumbraBound& bound);

/// Chooses the number of sky directions and sets `plan.sky`. If the sky is not sampled, adds the reason to
/// `plan.omitted`. `isAnythingHidden` is true if geometry may lie between a visible surface and the sky.
void planSky(FramePlan& plan, bool isAnythingHidden);

/// Removes the sampling of the sun's disc and of the sky from `plan`. Call this function if the image is drawn without
/// the sun.
void skipLightSampling(FramePlan& plan);

/// Returns the number of frames whose mean is the image. Each frame has another light direction of `plan`. Returns 1 if
/// one frame suffices.
int lightFrames(const FramePlan& plan);

} // namespace gnomon::plan
