// The values of all settings. The table of settings (table.h) contains the name, the text form and the help of each.
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

/// The backend that draws a plan, or Auto.
enum class Backend : std::uint8_t { Auto, Software, Osmesa, Egl, Window };
inline constexpr std::array kBackends = {
    Word<Backend>{Backend::Auto, "auto"},
    Word<Backend>{Backend::Software, "software"},
    Word<Backend>{Backend::Osmesa, "osmesa"},
    Word<Backend>{Backend::Egl, "egl"},
    Word<Backend>{Backend::Window, "window"},
};

/// Returns the default quality. Its shadow mode is Auto.
inline plan::Quality openQuality() {
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Auto;
    return quality;
}

/// The requested place and time of the Sun, and its position there. `sunAt` fills all members.
struct SunTime {
    sun::Place place;
    sun::CivilTime time;
    sun::SunPosition position;
};

/// A section plane through `point`. It removes all geometry on the side into which `normal` points.
struct Section {
    glm::dvec3 point{0};
    glm::dvec3 normal{0, 1, 0}; // any finite length above 0

    bool operator==(const Section&) const = default;
};

/// The max number of sections of a picture.
inline constexpr std::size_t kMaxSections = 6;

/// Cut: the geometry that sections remove casts no shadow. Keep: it casts shadows.
enum class SectionCasters : std::uint8_t { Cut, Keep };
inline constexpr std::array kSectionCasters = {
    Word<SectionCasters>{SectionCasters::Cut, "cut"},
    Word<SectionCasters>{SectionCasters::Keep, "keep"},
};

/// The requested view and quality. The values can contradict each other; the functions of settings/resolve.h check
/// this.
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
