#include "hierarchy/main_part.h"

#include <array>
#include <charconv>

namespace gnomon::hierarchy {

namespace {

constexpr const char* kOption = "main_part";

std::uint32_t coordinateOf(double value) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(value + 0.5), 0.0, double{kMaxGridCoordinate}));
}

} // namespace

void setMainPart(ModelSummary& summary, const Box& mainPart) {
    const Box& bounds = summary.bounds;
    if (mainPart.isEmpty() || (glm::all(glm::lessThanEqual(mainPart.min, bounds.min)) &&
                               glm::all(glm::greaterThanEqual(mainPart.max, bounds.max))))
        return;
    std::string text;
    for (const glm::dvec3& corner : {mainPart.min, mainPart.max})
        for (int axis = 0; axis < 3; ++axis)
            text += (text.empty() ? "" : ",") +
                    std::to_string(coordinateOf((corner[axis] - summary.grid.origin[axis]) / summary.grid.step()));
    summary.options[kOption] = text;
}

Box mainPartOf(const ModelSummary& summary) {
    const auto found = summary.options.find(kOption);
    if (found == summary.options.end()) return summary.bounds;
    std::array<std::uint32_t, 6> cells{};
    const char* next = found->second.data();
    const char* const end = next + found->second.size();
    for (std::uint32_t& cell : cells) {
        if (next != found->second.data() && (next == end || *next++ != ',')) return summary.bounds;
        const auto [after, error] = std::from_chars(next, end, cell);
        if (error != std::errc()) return summary.bounds;
        next = after;
    }
    const Box part{
        glm::max(summary.grid.world({cells[0], cells[1], cells[2]}), summary.bounds.min),
        glm::min(summary.grid.world({cells[3], cells[4], cells[5]}), summary.bounds.max)};
    return next == end && !part.isEmpty() ? part : summary.bounds;
}

} // namespace gnomon::hierarchy
