#include "viewer/panel/measure_note.h"

#include "inspect/cells.h"
#include "viewer/panel/notes.h"

namespace gnomon::viewer {

namespace {

constexpr ImU32 kLine = IM_COL32(255, 220, 60, 255);
constexpr ImU32 kDone = IM_COL32(120, 220, 255, 255);
constexpr ImU32 kOutline = IM_COL32(0, 0, 0, 200); // visible on any background

/// Returns the line segments between consecutive points of a measurement. A single point gives a segment of zero
/// length.
std::vector<Segment> segmentsOf(const inspect::Measure& measure, const hierarchy::Grid& grid) {
    std::vector<Segment> segments;
    const auto at = [&](std::size_t i) { return inspect::worldOf(grid, measure[i].cell); };
    for (std::size_t i = 0; i + 1 < measure.size(); ++i)
        segments.push_back({at(i), at(i + 1)});
    if (measure.size() == 1) segments.push_back({at(0), at(0)});
    return segments;
}

void drawMeasure(const inspect::Measure& measure, const hierarchy::Grid& grid, const PictureFrame& frame, ImU32 color) {
    const float thick = letterHeight() / 8;
    const auto legs = onPicture(segmentsOf(measure, grid), frame);
    drawSegments(legs, kOutline, 2.2F * thick);
    drawSegments(legs, color, thick);
    if (measure.size() > 2) {
        const Segment closing{
            inspect::worldOf(grid, measure.back().cell), inspect::worldOf(grid, measure.front().cell)};
        drawSegments(
            onPicture(std::span(&closing, 1), frame), (color & ~IM_COL32_A_MASK) | IM_COL32(0, 0, 0, 120), thick);
    }
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    std::size_t number = 0;
    for (const inspect::Point& point : measure) {
        ++number;
        const glm::dvec3 world = inspect::worldOf(grid, point.cell);
        const Segment place{world, world};
        const auto seen = onPicture(std::span(&place, 1), frame);
        if (seen.empty()) continue; // behind the eye
        const ImVec2 at = onScreen(seen[0][0]);
        draw.AddCircleFilled(at, 2.6F * thick, kOutline);
        draw.AddCircleFilled(at, 1.8F * thick, color);
        const std::string name = std::to_string(number);
        draw.AddText({at.x + 4 * thick + 1, at.y + 1}, kOutline, name.c_str());
        draw.AddText({at.x + 4 * thick, at.y}, color, name.c_str());
    }
}

} // namespace

void drawMeasures(const Measuring& measuring, const Camera& camera, std::size_t linesBelow) {
    const PictureFrame frame = windowFrame(camera);
    if (frame.width < 1 || frame.height < 1) return;
    const std::vector<inspect::Measure>& all = measuring.measures();
    for (const inspect::Measure& measure : all)
        drawMeasure(measure, measuring.of().grid, frame, &measure == &all.back() ? kLine : kDone);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float margin = 0.5F * letterHeight();
    const float below =
        linesBelow > 0 ? static_cast<float>(linesBelow) * ImGui::GetTextLineHeightWithSpacing() + 3 * margin : 0;
    if (beginNote("measure", {margin, screen.y - margin - below}, {0, 1})) {
        ImGui::PushTextWrapPos(std::max(screen.x - 4 * margin, 10 * letterHeight()));
        for (const std::string& line : measuring.inWords())
            drawLine(line);
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

} // namespace gnomon::viewer
