#include "viewer/panel/overlay.h"

#include "core/formatted.h"
#include "render/overlay/overlay_colors.h"
#include "viewer/panel/measure_note.h"
#include "viewer/panel/notes.h"
#include "viewer/panel/settings_panel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace gnomon::viewer {

namespace {

constexpr std::size_t kMessagesShown = 6; // number of visible messages, the most recent ones
constexpr ImU32 kFaint = IM_COL32(190, 195, 205, 255);
constexpr ImU32 kFailure = IM_COL32(255, 120, 110, 255);

constexpr std::array<ImU32, kStages> kStageColors = {
    IM_COL32(160, 130, 240, 255),
    IM_COL32(90, 160, 255, 255),
    IM_COL32(80, 210, 210, 255),
    IM_COL32(120, 210, 100, 255),
    IM_COL32(240, 200, 70, 255),
    IM_COL32(245, 130, 70, 255),
    IM_COL32(180, 180, 180, 255)};

/// Draws the times of the last frames as stacked bars, and the median time of each stage below.
void drawGraph(const FrameHistory& history, double targetMs) {
    const ImVec2 size(29 * letterHeight(), 5 * letterHeight());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(size);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const StageTimes medians = history.medians(30);
    const double top = std::max({2 * total(medians), 1.3 * targetMs, 1.0});
    const auto frames = history.frames();
    constexpr std::size_t kBars = 120;
    const std::size_t shown = std::min(frames.size(), kBars);
    const float wide = size.x / static_cast<float>(kBars);
    for (std::size_t i = 0; i < shown; ++i) {
        const StageTimes& times = frames[frames.size() - shown + i];
        const float left = at.x + wide * static_cast<float>(kBars - shown + i);
        float bottom = at.y + size.y;
        for (std::size_t stage = 0; stage < kStages; ++stage) {
            const float high = static_cast<float>(times[stage] / top) * size.y;
            const float upper = std::max(bottom - high, at.y);
            draw.AddRectFilled({left, upper}, {left + std::max(wide - 1, 1.0F), bottom}, kStageColors[stage]);
            bottom = upper;
        }
    }
    if (targetMs > 0) {
        const float y = at.y + size.y * static_cast<float>(1 - targetMs / top);
        draw.AddLine({at.x, y}, {at.x + size.x, y}, kWarningColor);
    }
    std::array<char, 64> text{};
    const double ms = total(medians);
    std::snprintf(text.data(), text.size(), "%.1f ms a frame, %.0f a second", ms, ms > 0 ? 1000 / ms : 0.0);
    drawLine(text.data());
    for (std::size_t stage = 0; stage < kStages; ++stage) {
        if (stage % 4 != 0) ImGui::SameLine(static_cast<float>(stage % 4) * 7.4F * letterHeight());
        std::snprintf(text.data(), text.size(), "%s %.1f", kStageNames[stage], medians[stage]);
        drawLine(text.data(), kStageColors[stage]);
    }
}

void drawFacts(const OverlayContent& content, const ViewSettings& settings) {
    const ImVec2 corner(0.5F * letterHeight(), 0.5F * letterHeight());
    if (beginNote("facts", corner, {0, 0})) {
        drawGraph(*content.history, settings.targetMs);
        const frame::Frame* frame = content.scene->frame();
        ImGui::Separator();
        for (const std::string& line :
             loadInWords(frame->row, frame->plan.quality, content.caps, frame->cut.used.size()))
            drawLine(line);
        ImGui::Separator();
        ImGui::PushTextWrapPos(29 * letterHeight());
        for (const std::string& line : planInWords(frame->plan, frame->row))
            drawLine(line);
        ImGui::PopTextWrapPos();
        std::array<char, 96> text{};
        if (settings.targetMs > 0) {
            const std::string& given = content.reductions;
            std::snprintf(text.data(), text.size(), "target %.3g ms: ", settings.targetMs);
            drawLine(
                text.data() + (given.empty() ? std::string("nothing given up") : "given up " + given) +
                    (content.isExhausted ? "; no more can be" : ""),
                kWarningColor);
        }
        if (content.scene->samples() > 0)
            drawLine(formatted("sample %d of %d", content.scene->samples(), content.maxSamples));
        std::snprintf(text.data(), text.size(), "speed %.3g a second   H help, Tab panel", content.flyingSpeed);
        drawLine(text.data(), kFaint);
        if (settings.overlay != render::Overlay::None)
            drawLine(std::string("overlay: ") + render::title(settings.overlay), kFaint);
    }
    ImGui::End();
}

/// Draws one line about the state of the image. If the model is out of view, also draws a hint.
void drawStatus(const OverlayContent& content) {
    const frame::Frame& frame = *content.scene->frame();
    PictureState state;
    state.frameMs = total(content.history->medians(15));
    state.samples = content.scene->samples();
    state.maxSamples = content.maxSamples;
    state.reductions = content.reductions;
    const std::string text = statusInWords(frame.plan, frame.row, state);
    const float widest = std::max(ImGui::GetIO().DisplaySize.x - 2 * letterHeight(), 8 * letterHeight());
    // Sets the size of the note, because Dear ImGui would otherwise use the size of the previous frame.
    ImGui::SetNextWindowContentSize(ImGui::CalcTextSize(text.c_str(), nullptr, false, widest));
    if (beginNote("status", {0.5F * letterHeight(), 0.5F * letterHeight()}, {0, 0})) {
        ImGui::PushTextWrapPos(widest);
        drawLine(text);
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

void drawNothingInView() {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    if (beginNote("nothing", {screen.x * 0.5F, screen.y * 0.5F}, {0.5F, 0.5F}))
        drawLine("nothing in view, Home brings it back", kWarningColor);
    ImGui::End();
}

/// Returns the lines of the help.
std::vector<std::pair<std::string, std::string>> helpLines() {
    std::vector<std::pair<std::string, std::string>> lines;
    for (const MouseUse& use : mouseUses())
        lines.emplace_back(use.gesture, use.help);
    for (const Binding& binding : bindings())
        lines.emplace_back(binding.keyName, binding.help);
    return lines;
}

/// Draws the help of keys and mouse, in as many columns as the height of the window requires. The letters are scaled to
/// fit its width.
void drawHelp() {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const auto lines = helpLines();
    const float fit = std::max(1.0F, screen.y / ImGui::GetTextLineHeightWithSpacing() - 4);
    const int columns = std::clamp(static_cast<int>(std::ceil(static_cast<float>(lines.size()) / fit)), 1, 3);
    const std::size_t perColumn =
        (lines.size() + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns);
    float keyWidest = 0;
    float widest = 0;
    for (const auto& [key, help] : lines) {
        keyWidest = std::max(keyWidest, ImGui::CalcTextSize(key.c_str()).x);
        widest = std::max(widest, ImGui::CalcTextSize(help.c_str()).x);
    }
    const float wide = static_cast<float>(columns) * (keyWidest + 2 * letterHeight() + widest) + letterHeight();
    ImGui::SetNextWindowBgAlpha(0.95F);
    if (beginNote("help", {screen.x * 0.5F, screen.y * 0.5F}, {0.5F, 0.5F})) {
        const float scale = std::min(1.0F, screen.x / wide);
        ImGui::SetWindowFontScale(scale);
        for (std::size_t first = 0; first < lines.size(); first += perColumn) {
            if (first > 0) ImGui::SameLine(0, letterHeight());
            ImGui::BeginGroup();
            for (std::size_t i = first; i < std::min(first + perColumn, lines.size()); ++i) {
                drawLine(lines[i].first, kWarningColor);
                ImGui::SameLine(scale * (keyWidest + letterHeight()));
                drawLine(lines[i].second);
            }
            ImGui::EndGroup();
        }
    }
    ImGui::End();
}

void drawMessages(const OverlayContent& content) {
    if (content.messages->empty()) return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    if (beginNote("messages", {screen.x * 0.5F, screen.y - 0.5F * letterHeight()}, {0.5F, 1})) {
        ImGui::PushTextWrapPos(std::max(screen.x - 2 * letterHeight(), 10 * letterHeight()));
        const std::vector<Message>& all = *content.messages;
        for (std::size_t i = all.size() - std::min(all.size(), kMessagesShown); i < all.size(); ++i)
            drawLine(all[i].text, all[i].isError ? kFailure : IM_COL32_WHITE);
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

void drawBuild(const BuildStatus& status, const std::string& mesh) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    if (beginNote("build", {screen.x * 0.5F, screen.y * 0.5F}, {0.5F, 0.5F})) {
        drawLine("building a model of " + mesh);
        const double part =
            status.total > 0 ? static_cast<double>(status.done) / static_cast<double>(status.total) : 0.0;
        const std::string text = status.stage + ": " + readableCount(status.done) +
                                 (status.total > 0 ? " of " + readableCount(status.total) : "") + " " + status.unit;
        ImGui::ProgressBar(static_cast<float>(std::min(part, 1.0)), {24 * letterHeight(), 0}, "");
        drawLine(text);
        std::array<char, 32> seconds{};
        std::snprintf(seconds.data(), seconds.size(), "%.0f s", status.seconds);
        drawLine(seconds.data(), kFaint);
    }
    ImGui::End();
}

/// Returns the colour that the partitions overlay uses for the partition with index `index`.
ImU32 indexColor(std::size_t index, float alpha) {
    const glm::vec3 color = render::indexColor(static_cast<int>(index % render::kIndexColors));
    return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, alpha});
}

/// Draws the wire frames of a frame whose culling is frozen: each partition of the view in its colour, the volume of
/// its shadow casters in a fainter colour, and the depth range of the view in white.
void drawVolumes(const OverlayContent& content) {
    const plan::FramePlan& plan = content.scene->frame()->plan;
    const PictureFrame frame = windowFrame(content.camera);
    if (frame.width < 1 || frame.height < 1) return;
    const float thick = letterHeight() / 8;
    for (const PlanVolume& volume : planVolumes(plan, content.scene->model().summary().bounds)) {
        const auto lines = onPicture(volume.edges, frame);
        switch (volume.kind) {
        case PlanVolume::Kind::View:
            drawSegments(lines, IM_COL32_WHITE, thick);
            break;
        case PlanVolume::Kind::Partition:
            drawSegments(lines, indexColor(volume.index, 1), thick);
            break;
        case PlanVolume::Kind::Casters:
            drawSegments(lines, indexColor(volume.index, 0.45F), thick * 0.6F);
            break;
        }
    }
}

} // namespace

void drawPicture(const ShownPicture& picture) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const auto id = reinterpret_cast<ImTextureID>( // NOLINT(performance-no-int-to-ptr): the interface of Dear ImGui
        static_cast<std::uintptr_t>(picture.texture));
    const ImVec2 first(0, picture.isBottomUp ? 1.0F : 0.0F);
    const ImVec2 last(1, picture.isBottomUp ? 0.0F : 1.0F);
    ImGui::GetBackgroundDrawList()->AddImage(id, {0, 0}, screen, first, last);
}

OverlayAnswer drawOverlay(const OverlayContent& content, ViewSettings& settings, TexelPlot& plot) {
    OverlayAnswer answer;
    const bool hasFrame = content.scene != nullptr && content.scene->frame() != nullptr;
    if (hasFrame && content.isFrozen) drawVolumes(content);
    if (hasFrame && content.measuring != nullptr)
        drawMeasures(*content.measuring, content.camera, std::min(content.messages->size(), kMessagesShown));
    if (hasFrame && settings.showsFacts) drawFacts(content, settings);
    if (hasFrame && !settings.showsFacts) drawStatus(content);
    if (hasFrame && !content.scene->isAnythingInView() && !settings.showsHelp) drawNothingInView();
    if (hasFrame && settings.showsPanel) answer = drawPanel(content, settings, plot);
    if (settings.showsHelp) drawHelp();
    if (content.build) drawBuild(*content.build, content.buildOf);
    drawMessages(content);
    return answer;
}

} // namespace gnomon::viewer
