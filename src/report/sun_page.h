// Hours of sun as one self-contained page with a slider over the times.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::report {

/// The content of the page.
struct SunPage {
    /// A time with the Sun above the horizon. `lit` are the sunlit pixels and the background pixels, encoded by
    /// `litRuns`.
    struct Step {
        std::string time;
        std::vector<std::uint8_t> lit;
    };

    /// A number below the colour scale, at a place from 0 to 1.
    struct Figure {
        double place = 0;
        std::string text;
    };

    std::string about;               // model, place and date
    std::vector<std::string> errors; // one sentence per source of error
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> picture; // PNG with hours as colours
    std::vector<std::string> colors;   // colours of the scale, "#rrggbb", evenly spaced
    std::vector<Figure> figures;
    std::vector<Step> steps; // at least one
};

/// Encodes `isLit` (0 or not 0) as run lengths, alternating between unlit and lit, starting with unlit. A length has 7
/// bits per byte, the lowest first. The high bit is set if more bytes follow.
std::vector<std::uint8_t> litRuns(const std::vector<std::uint8_t>& isLit);

/// Returns the HTML text of the page.
std::string sunPage(const SunPage& page);

} // namespace gnomon::report
