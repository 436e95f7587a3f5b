// How many directions the light of a picture is summed over: of the sun's disc, where its penumbrae show, and of the
// sky, where anything stands in its way.
#pragma once

#include "core/words.h"
#include "shadow/image_tiles.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::plan {

/// How bright the sky is. Uniform: everywhere alike. Overcast: the CIE's standard overcast sky, three times as bright
/// at the zenith as at the horizon (Moon, Spencer 1942). A surface that sees all of it gets the same light of both.
enum class SkyModel : std::uint8_t { Uniform, Overcast };
inline constexpr std::array kSkyModels = {
    Word<SkyModel>{SkyModel::Uniform, "uniform"},
    Word<SkyModel>{SkyModel::Overcast, "overcast"},
};

/// From how many directions the light of the sky is to be summed up; 0: it is not, and nothing hides any of it.
struct SkyLight {
    int directions = 0;
    SkyModel model = SkyModel::Uniform;

    bool operator==(const SkyLight&) const = default;
};

/// What a plan says of penumbrae.
struct Penumbra {
    double widestPixels = 0; // none in view is wider, across the beam
    double leastPixels = 0;  // under that the light is a point
    int directions = 1;      // over the disc of the light; 1: a point
    /// Where they may be at least so wide, of more than one direction; null: anywhere.
    std::shared_ptr<const shadow::TileMask> tiles{};
};

/// How wide penumbrae are in the tiles of an image, at most, across the beam, in its pixels. Without tiles no penumbra
/// is wider than `widest`, wherever it is.
struct PenumbraBound {
    double widest = 0;
    shadow::ImageTiles tiles;
    std::span<const double> byTile{};
};

struct FramePlan;

/// What the frame calls for that `plan` plans, whose view and quality are set, if no penumbra in it is wider than
/// `bound` says. Says in `plan` what is left out.
void planPenumbra(FramePlan& plan, const PenumbraBound& bound);

/// Likewise for the sky; `isAnythingHidden` is whether anything may stand between a visible surface and a part of it.
void planSky(FramePlan& plan, bool isAnythingHidden);

/// Leaves both out of `plan` after all: the picture turned out to have no sun.
void leaveLightSamplingOut(FramePlan& plan);

/// Frames that a picture of `plan` takes in which each has a direction of its own; 1 where the light needs no more.
int lightFrames(const FramePlan& plan);

} // namespace gnomon::plan
