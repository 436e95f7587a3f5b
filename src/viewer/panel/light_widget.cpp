#include "viewer/panel/light_widget.h"

#include <algorithm>
#include <cmath>

#include <imgui/imgui.h>

namespace gnomon::viewer {

namespace {

// Max number of storage factors of the light widget that a frame computes. Each one takes well under a millisecond.
constexpr int kAnswersAFrame = 24;

/// Returns the colour of a value from 0 to 1: dark blue (0) through green and yellow to white (1).
ImU32 heat(double part) {
    const std::array<ImVec4, 4> kStops = {
        ImVec4{0.10F, 0.16F, 0.45F, 1}, {0.10F, 0.60F, 0.45F, 1}, {0.95F, 0.80F, 0.25F, 1}, {1, 0.97F, 0.90F, 1}};
    const double at = std::clamp(part, 0.0, 1.0) * static_cast<double>(kStops.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    const auto mix = static_cast<float>(at - static_cast<double>(first));
    const ImVec4& a = kStops[first];
    const ImVec4& b = kStops[first + 1];
    return ImGui::ColorConvertFloat4ToU32(
        {a.x + (b.x - a.x) * mix, a.y + (b.y - a.y) * mix, a.z + (b.z - a.z) * mix, 1});
}

/// Returns the input from which the texel plot of a frame is computed, or nullopt if the frame has no shadow maps.
std::optional<TexelPlotInput> plotInput(const frame::Frame* frame, const LightDisc& disc) {
    if (frame == nullptr || frame->plan.passes.empty()) return std::nullopt;
    const plan::FramePlan& plan = frame->plan;
    TexelPlotInput input;
    input.disc = disc;
    input.basis = plan.basis;
    input.frustum = {plan.near, plan.far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
    input.scheme.warp = plan.quality.warp;
    if (plan.quality.stabilize) input.scheme.warp.rule = shadow::WarpRule::None;
    input.scheme.slices = static_cast<int>(std::max<std::size_t>(plan.splits.size(), 2)) - 1;
    input.scheme.splitLambda = plan.quality.splitLambda;
    input.scheme.faces = plan.hasFaces;
    input.scheme.nearFace = shadow::NearFace::Stretch;
    return input;
}

void drawCells(const TexelPlot& plot, const ImVec2& at, float side) {
    const auto range = plot.range();
    if (!range) return;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float cell = side / static_cast<float>(plot.side());
    const double octaves = std::max(std::log2(range->max / range->min), 1e-9);
    for (int row = 0; row < plot.side(); ++row)
        for (int column = 0; column < plot.side(); ++column) {
            const auto value = plot.at(column, row);
            if (!value) continue;
            const float left = at.x + cell * static_cast<float>(column);
            const float top = at.y + cell * static_cast<float>(plot.side() - 1 - row);
            draw.AddRectFilled(
                {left, top}, {left + cell + 1, top + cell + 1}, heat(std::log2(*value / range->min) / octaves));
        }
}

} // namespace

bool drawLightWidget(const frame::Frame* frame, const Camera& camera, TexelPlot& plot, glm::dvec3& towardsLight) {
    bool isBelow = glm::dot(towardsLight, camera.up) < 0;
    const bool wasBelow = isBelow;
    LightDisc disc = lightDisc(camera, isBelow);
    const auto input = plotInput(frame, disc);
    plot.ask(input);
    plot.improve(kAnswersAFrame);
    const float side = 11 * ImGui::GetFontSize();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("light", {side, side});
    bool hasChanged = false;
    if (ImGui::IsItemActive()) {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        glm::dvec2 point(2 * (mouse.x - at.x) / side - 1, 1 - 2 * (mouse.y - at.y) / side);
        constexpr double kMaxRadius = 0.985; // a light on the horizon would be ambiguous
        if (glm::length(point) > kMaxRadius) point *= kMaxRadius / glm::length(point);
        towardsLight = disc.direction(point);
        hasChanged = true;
    }
    drawCells(plot, at, side);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 middle(at.x + side / 2, at.y + side / 2);
    draw.AddCircle(middle, side / 2, IM_COL32(255, 255, 255, 200), 64);
    draw.AddCircle(middle, side / 4, IM_COL32(255, 255, 255, 60), 64);
    const glm::dvec2 light = disc.point(towardsLight);
    const ImVec2 dot(
        middle.x + static_cast<float>(light.x) * side / 2, middle.y - static_cast<float>(light.y) * side / 2);
    draw.AddCircleFilled(dot, side / 24, IM_COL32(20, 20, 20, 255));
    draw.AddCircleFilled(dot, side / 34, IM_COL32(255, 240, 160, 255));
    ImGui::SameLine();
    ImGui::BeginGroup();
    ImGui::TextUnformatted("light: drag\nup: ahead\nmiddle: overhead");
    if (input && plot.range()) {
        const auto range = *plot.range();
        const double here = storageFactor(*input, towardsLight);
        ImGui::Text("storage factor,\nmaps not turned\n%.3g here\n%.3g dark\n%.3g white", here, range.min, range.max);
    }
    ImGui::Checkbox("from below", &isBelow);
    ImGui::EndGroup();
    if (isBelow != wasBelow) {
        disc.fromBelow = isBelow;
        towardsLight -= 2 * glm::dot(towardsLight, disc.up) * disc.up;
        hasChanged = true;
    }
    return hasChanged;
}

} // namespace gnomon::viewer
