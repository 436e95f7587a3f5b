// The values of all settings, each of its own type; table.h says how each is called, written and changed.
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

/// Where a plan is executed.
enum class Backend : std::uint8_t { Auto, Software, Osmesa, Egl, Window };
inline constexpr std::array kBackends = {
    Word<Backend>{Backend::Auto, "auto"},
    Word<Backend>{Backend::Software, "software"},
    Word<Backend>{Backend::Osmesa, "osmesa"},
    Word<Backend>{Backend::Egl, "egl"},
    Word<Backend>{Backend::Window, "window"},
};

/// The default quality. Its shadows are Auto.
inline plan::Quality openQuality() {
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Auto;
    return quality;
}

/// Where and when the Sun is asked for.
struct SunTime {
    sun::Place place;
    sun::CivilTime time;
};

/// A plane by a point and a direction; what lies on that side of it is cut away.
struct Section {
    glm::dvec3 point{0};
    glm::dvec3 normal{0, 1, 0}; // of a finite length above 0

    bool operator==(const Section&) const = default;
};

/// How many sections a picture may have.
inline constexpr std::size_t kMostSections = 6;

/// Whether what sections cut away casts shadows.
enum class SectionCasters : std::uint8_t { Cut, Keep };
inline constexpr std::array kSectionCasters = {
    Word<SectionCasters>{SectionCasters::Cut, "cut"},
    Word<SectionCasters>{SectionCasters::Keep, "keep"},
};

/// What a person can ask for of a view and its quality. What stands in `quality` the plan takes as it is.
struct Settings {
    std::array<int, 2> imageSize{800, 800}; // pixels
    std::string cameraFile;                 // empty: none
    std::optional<glm::dvec3> eye;          // nothing: frames the model
    std::optional<glm::dvec3> target;
    std::optional<glm::dvec3> up;
    std::optional<double> fovYDegrees;
    std::optional<path::ViewSide> side;   // nothing: a three-quarter view
    std::optional<Projection> projection; // nothing: the camera file's or the path's, else perspective
    glm::dvec3 towardsLight{0.4, 1, 0.3};
    bool isLightGiven = false;             // towardsLight was asked for; else it stands in a world with y up
    std::optional<glm::dvec3> lightAt;     // a point light there takes the place of towardsLight
    std::optional<SunTime> sun;            // takes the place of towardsLight
    std::optional<double> north;           // degrees; see --north
    std::optional<double> sunAngleDegrees; // across the light's disc; nothing: the sun's with `sun`, else a point
    std::vector<Section> sections;
    SectionCasters sectionCasters = SectionCasters::Cut;
    plan::Quality quality = openQuality();
    bool isWarpGiven = false;       // quality.warp.rule was asked for
    std::optional<double> eta;      // takes the place of quality.warp.rule
    std::optional<double> tsmFocus; // 0: found by itself
    Backend backend = Backend::Auto;
    Bytes memory = gibibytes(1);
    Bytes gpuMemory = gibibytes(1);
    std::string shaderFolder; // empty: the built-in ones
};

} // namespace gnomon::settings
