// Hours of sun as one self-contained page with a slider over the times.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::report {

/// What the page shows.
struct SunPage {
    /// A time at which the Sun is up, and the pixels that it reaches then or where nothing is, as `litRuns` writes
    /// them.
    struct Step {
        std::string time;
        std::vector<std::uint8_t> lit;
    };

    /// A figure below the scale; places go from 0 to 1.
    struct Figure {
        double place = 0;
        std::string text;
    };

    std::string about;               // which model, where, when
    std::vector<std::string> errors; // what it is off by, a sentence each
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> picture; // PNG of hours as colours
    std::vector<std::string> colors;   // of the scale, "#rrggbb", even steps apart
    std::vector<Figure> figures;
    std::vector<Step> steps; // at least one
};

/// Lengths of runs of pixels, unlit and lit in turn, the first unlit, each in bytes of 7 bits, the lowest first, whose
/// high bit says that more follow. `isLit` is 0 or not.
std::vector<std::uint8_t> litRuns(const std::vector<std::uint8_t>& isLit);

/// The page's text.
std::string sunPage(const SunPage& page);

} // namespace gnomon::report
