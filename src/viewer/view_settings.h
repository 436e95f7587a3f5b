// What the keys and the panel change: quality, overlay, light, and what is shown beside the picture.
#pragma once

#include "executor/executor.h"
#include "plan/frame_plan.h"

#include <array>
#include <span>
#include <string>

namespace gnomon::viewer {

/// The ways of casting shadows that a key steps through; slices, faces and warp make all others.
enum class Scheme : std::uint8_t { Off, OneMap, Slices, Faces, FacesAndSlices, Rays };

inline constexpr std::array kSchemes = {
    Scheme::Off, Scheme::OneMap, Scheme::Slices, Scheme::Faces, Scheme::FacesAndSlices, Scheme::Rays};

/// "no shadows", "one map", ...
const char* name(Scheme scheme);

/// An overlay with its name.
struct OverlayName {
    executor::Overlay overlay;
    const char* name;
};

/// All overlays in the order of their keys.
std::span<const OverlayName> overlayNames();

/// The name of an overlay.
const char* name(executor::Overlay overlay);

/// The warp rules that can be chosen, in the order of their key.
std::span<const shadow::WarpRule> warpRules();

/// The settings of a window.
struct ViewSettings {
    plan::Quality quality;
    glm::dvec3 towardsLight{0.4, 1, 0.3};
    executor::Overlay overlay = executor::Overlay::None;
    double targetMs = 0; // 0: none
    bool showsFacts = true;
    bool showsPanel = false;
    bool showsHelp = false;
};

/// The scheme that `quality` asks for.
Scheme schemeOf(const plan::Quality& quality);

/// Asks for `scheme`; slices keep their number, and get four where there was one.
void choose(Scheme scheme, plan::Quality& quality);

/// The steps of the keys. Each returns what is now set, for people.
std::string stepScheme(plan::Quality& quality, int step);
std::string stepWarp(plan::Quality& quality, int step);
std::string stepSlices(plan::Quality& quality, int step); // 0 turns auto on or off
std::string stepFaces(plan::Quality& quality);
std::string stepTexels(plan::Quality& quality, int step); // twice or half as many
std::string stepFilter(plan::Quality& quality);
std::string stepDetail(plan::Quality& quality, int step); // by a factor of sqrt(2)
std::string toggleCulling(plan::Quality& quality);
std::string toggleStabilising(plan::Quality& quality);

/// The least and the most that the window offers.
constexpr double kLeastErrorPixels = 0.125;
constexpr double kMostErrorPixels = 64;
constexpr int kLeastShadowTexels = 256; // a side
constexpr int kMostShadowTexels = 8192;

} // namespace gnomon::viewer
