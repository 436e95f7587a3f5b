// The settings that the user changes in the window: quality, overlay, light, and the visible elements of the user
// interface.
#pragma once

#include "hierarchy/model.h"
#include "render/backend.h"
#include "settings/settings.h"
#include "settings/value_colors.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace gnomon::viewer {

/// The kinds of shadows that a key cycles through. Slices, faces and warp can also be set separately.
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

/// Returns the name of a shadow scheme, for example "no shadows" or "one map".
const char* name(Scheme scheme);

/// The settings of a window.
struct ViewSettings {
    settings::Settings asked; // without contradictions: `quality` describes the drawn image
    render::Overlay overlay = render::Overlay::None;
    settings::ValueColors colors; // in images without an overlay
    double targetMs = 0;          // 0: no target
    bool showsFacts = false;      // all statistics; otherwise one line
    bool usesEyeDome = false;
    bool showsPanel = false;
    bool showsHelp = false;
};

/// Returns the values by which a backend with `capabilities` can colour a picture of `model`, such as height or error.
/// The first entry is None.
std::vector<settings::ValueColors> colorChoices(
    const hierarchy::ModelSummary& model, const plan::Capabilities& capabilities);

/// Returns the initial range of the colour map, which contains all values of `model`. The range of errors is from the
/// max error of the finest level to that of the coarsest level. `up` has any length above 0.
std::array<double, 2> widestEnds(
    const settings::ValueColors& colors, const hierarchy::ModelSummary& model, const glm::dvec3& up);

/// Returns true if one of `choices` shows the same value of the surface as `colors`.
bool isAmong(std::span<const settings::ValueColors> choices, const settings::ValueColors& colors);

/// Changes `colors` to the choice that is `step` positions later in `choices`, cyclically. The colour map does not
/// change. Returns a description of the new choice.
std::string stepColors(std::span<const settings::ValueColors> choices, int step, settings::ValueColors& colors);

/// Returns the scheme that `quality` describes.
Scheme schemeOf(const plan::Quality& quality);

/// Changes `quality` to the shadows of `scheme`. The number of slices does not change, except that one slice becomes
/// four.
void choose(Scheme scheme, plan::Quality& quality);

/// Changes the shadow scheme of `quality` to the one that is `step` positions later, cyclically.
void stepScheme(plan::Quality& quality, int step);

} // namespace gnomon::viewer
