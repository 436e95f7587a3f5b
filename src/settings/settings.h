// Stores the values of all settings. For each setting, table.h contains the name, the text form and the help.
#pragma once

#include "core/units.h"
#include "core/words.h"
#include "path/framing.h"
#include "plan/frame_plan.h"
#include "sun/civil_time.h"
#include "sun/sun_position.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::settings {

/// The implementation that draws frames: a software rasteriser or OpenGL through OSMesa, EGL or the window. Auto
/// selects one of them.
enum class Backend : std::uint8_t { Auto, Software, Osmesa, Egl, Window };
inline constexpr std::array kBackends = {
    Word<Backend>{Backend::Auto, "auto"},
    Word<Backend>{Backend::Software, "software"},
    Word<Backend>{Backend::Osmesa, "osmesa"},
    Word<Backend>{Backend::Egl, "egl"},
    Word<Backend>{Backend::Window, "window"},
};

/// Returns the default quality settings. Their shadow mode is Auto, so Gnomon chooses the kind of shadows.
inline plan::Quality openQuality() {
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Auto;
    return quality;
}

/// The place and time that the user requests for the Sun, and the position of the Sun there. `sunAt` fills all members.
struct SunTime {
    sun::Place place;
    sun::CivilTime time;
    sun::SunPosition position;
};

/// A plane through `point` that cuts the model. All geometry on the side into which `normal` points is removed.
struct Section {
    glm::dvec3 point{0};
    glm::dvec3 normal{0, 1, 0}; // any finite length above 0

    bool operator==(const Section&) const = default;
};

/// The max number of section planes of a picture.
inline constexpr std::size_t kMaxSections = 6;

/// Tells whether geometry that a section removes still casts shadows. Cut: it casts no shadow. Keep: it casts shadows.
enum class SectionCasters : std::uint8_t { Cut, Keep };
inline constexpr std::array kSectionCasters = {
    Word<SectionCasters>{SectionCasters::Cut, "cut"},
    Word<SectionCasters>{SectionCasters::Keep, "keep"},
};

/// The view and the quality that the user requests. The values can contradict each other. The functions of
/// settings/resolve.h reject contradictions.
struct Settings {
    std::array<int, 2> imageSize{800, 800}; // pixels
    std::string cameraFile;                 // empty: none
    std::optional<Camera> camera;           // of the camera file, see readCamera
    std::optional<glm::dvec3> eye;          // nothing: frames the model
    std::optional<glm::dvec3> target;
    std::optional<glm::dvec3> up;
    std::optional<double> fovYDegrees;
    std::optional<path::ViewSide> side;   // nullopt: a three-quarter view
    std::optional<Projection> projection; // nullopt: from the camera file or the path, else perspective
    glm::dvec3 towardsLight{0.4, 1, 0.3};
    bool isLightGiven = false;             // false: path::usualLight for the up direction replaces towardsLight
    std::optional<glm::dvec3> lightAt;     // position of a point light, which replaces towardsLight
    std::optional<SunTime> sun;            // replaces towardsLight by the direction of the Sun
    std::optional<double> north;           // degrees, clockwise seen from above; see --north
    std::optional<double> sunAngleDegrees; // diameter of the light's disc; nullopt: the Sun's with `sun`, else 0
    std::vector<Section> sections;
    SectionCasters sectionCasters = SectionCasters::Cut;
    plan::Quality quality = openQuality();
    bool isWarpGiven = false;       // quality.warp.rule is requested by an option
    std::optional<double> eta;      // replaces quality.warp.rule; [-1, 1] of Lloyd et al. 2006
    std::optional<double> tsmFocus; // distance from near; 0: automatic
    Backend backend = Backend::Auto;
    Bytes memory = gibibytes(1);
    Bytes gpuMemory = gibibytes(1);
    std::string shaderFolder; // empty: the built-in shaders
};

} // namespace gnomon::settings
