#include "settings/backend_choice.h"

#include "core/check.h"
#include "settings/table.h"

#include <algorithm>
#include <array>

namespace gnomon::settings {

namespace {

using plan::Capabilities;

/// A capability that some backends lack: its verb for messages, the option that needs it, and the condition under which
/// settings need it.
struct Need {
    bool Capabilities::*capability;
    const char* verb;
    const char* option; // name of the setting, without "--"
    bool (*isRequested)(const Settings&, const ValueColors&);
};

constexpr std::array kNeeds = {
    Need{
        &Capabilities::exactShadows,
        "draws exact shadows",
        "shadows",
        [](const Settings& s, const ValueColors&) { return s.quality.shadows == plan::ShadowMode::Exact; }},
    Need{
        &Capabilities::unevenRows,
        "draws logarithmic maps",
        "warp",
        [](const Settings& s, const ValueColors&) {
            return shadow::rowsOf(s.quality.warp.rule) == shadow::RowSpacing::Logarithmic;
        }},
    Need{
        &Capabilities::imageFirst,
        "finds receivers before it draws maps",
        "cull-casters",
        [](const Settings& s, const ValueColors&) { return s.quality.cullCasters == plan::CasterCulling::Receivers; }},
    Need{
        &Capabilities::occlusionCulling,
        "skips hidden clusters",
        "occlusion",
        [](const Settings& s, const ValueColors&) { return s.quality.occlusion == plan::Choice::On; }},
    Need{
        &Capabilities::sections,
        "draws sections",
        "section",
        [](const Settings& s, const ValueColors&) { return !s.sections.empty(); }},
    Need{
        &Capabilities::ground,
        "draws the ground",
        "ground",
        [](const Settings& s, const ValueColors&) { return s.quality.look.ground; }},
    Need{
        &Capabilities::seesTriangles,
        "knows the colours, errors and fields of the visible triangles",
        "color-by",
        [](const Settings&, const ValueColors& colors) { return isOfTriangles(colors.by); }},
};

std::string writtenNeed(const Need& need, const Settings& settings, const ValueColors& colors) {
    if (need.capability == &Capabilities::seesTriangles) return "--color-by " + nameOf(colors);
    return optionText(need.option, settings);
}

} // namespace

BackendChoice chooseBackend(const BackendRequest& request) {
    if (request.requested != Backend::Auto) return {request.requested, "it is requested"};
    if (request.need) return {Backend::Software, request.need->reason + " (" + request.need->option + ")"};
    if (request.command == DrawingCommand::Render && request.pictures == 1)
        return {Backend::Software, "it draws one picture in less time than a GPU takes to open"};
    if (!request.hasGpu) return {Backend::Software, "this machine has no GPU"};
    return {request.command == DrawingCommand::View ? Backend::Window : Backend::Egl, "this machine has a GPU"};
}

Capabilities capabilitiesOf(Backend backend) {
    GNOMON_CHECK(backend != Backend::Auto);
    return backend == Backend::Software ? plan::kSoftwareCapabilities : plan::kOpenGlCapabilities;
}

std::string onlySoftware(bool Capabilities::*capability) {
    const auto found =
        std::find_if(kNeeds.begin(), kNeeds.end(), [&](const Need& need) { return need.capability == capability; });
    GNOMON_CHECK(found != kNeeds.end());
    return std::string("only the software backend ") + found->verb;
}

std::optional<BackendNeed> missingCapability(
    const Settings& settings, const ValueColors& colors, const Capabilities& capabilities) {
    for (const Need& need : kNeeds)
        if (!(capabilities.*need.capability) && need.isRequested(settings, colors))
            return BackendNeed{writtenNeed(need, settings, colors), onlySoftware(need.capability)};
    return std::nullopt;
}

std::optional<BackendNeed> softwareNeed(const Settings& settings, const ValueColors& colors) {
    return missingCapability(settings, colors, plan::kOpenGlCapabilities);
}

void requireCapable(const Settings& settings, const ValueColors& colors) {
    if (settings.backend == Backend::Auto) return;
    if (const auto need = missingCapability(settings, colors, capabilitiesOf(settings.backend)))
        throw UsageError{
            "--backend",
            optionText("backend", settings) + " and " + need->option + " contradict each other: " + need->reason};
}

} // namespace gnomon::settings
