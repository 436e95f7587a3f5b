// What the keys and the panel change: quality, overlay, light, and what is shown beside the picture.
#pragma once

#include "executor/executor.h"
#include "hierarchy/model.h"
#include "settings/settings.h"
#include "settings/value_colors.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace gnomon::viewer {

/// The ways of casting shadows that a key steps through; slices, faces and warp make all others.
enum class Scheme : std::uint8_t { Off, OneMap, Slices, Faces, FacesAndSlices, Exact, Rays, Auto };

inline constexpr std::array kSchemes = {
    Scheme::Off,
    Scheme::OneMap,
    Scheme::Slices,
    Scheme::Faces,
    Scheme::FacesAndSlices,
    Scheme::Exact,
    Scheme::Rays,
    Scheme::Auto};

/// "no shadows", "one map", ...
const char* name(Scheme scheme);

/// The settings of a window.
struct ViewSettings {
    settings::Settings asked; // contradictions are resolved: what `quality` says is what is drawn
    executor::Overlay overlay = executor::Overlay::None;
    settings::ValueColors colors; // of pictures without an overlay
    double targetMs = 0;          // 0: none
    bool showsFacts = false;      // all of them; else a line
    bool darkensHollows = false;
    bool showsPanel = false;
    bool showsHelp = false;
};

/// Returns the values that can colour a picture of `model` by a backend with `capabilities`; first None.
std::vector<settings::ValueColors> colorChoices(
    const hierarchy::ModelSummary& model, const plan::Capabilities& capabilities);

/// Ends for the map of `colors`, from which a person may move them: all that `model` has of it, of errors all above the
/// finest. `up` has any length above 0.
std::array<double, 2> widestEnds(
    const settings::ValueColors& colors, const hierarchy::ModelSummary& model, const glm::dvec3& up);

/// Whether one of the choices is by the same value.
bool isAmong(std::span<const settings::ValueColors> choices, const settings::ValueColors& colors);

/// Asks for the choice that lies `step` behind that of `colors`, around, in the same map; returns what is now set, for
/// people.
std::string stepColors(std::span<const settings::ValueColors> choices, int step, settings::ValueColors& colors);

/// The scheme that `quality` asks for.
Scheme schemeOf(const plan::Quality& quality);

/// Asks for `scheme`; slices keep their number, and get four where there was one.
void choose(Scheme scheme, plan::Quality& quality);

/// Asks for the scheme that lies `step` behind the one of `quality`, around.
void stepScheme(plan::Quality& quality, int step);

} // namespace gnomon::viewer
