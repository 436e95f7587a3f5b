#include "settings/help_table.h"

#include "core/check.h"

#include <string>

namespace gnomon::settings {

namespace {

// The commands that draw or compute a view of a model.
constexpr std::string_view kOfViews = "render view explain measure hours";

constexpr std::array kRows = {
    HelpRow{"source", Group::Input, "*"},
    HelpRow{"point", Group::Input, "*"},
    HelpRow{"pixel", Group::Input, "*"},
    HelpRow{"points", Group::Input, "*"},
    HelpRow{"vertices", Group::Input, "*"},
    HelpRow{"build up", Group::Input, "*"},
    HelpRow{"unit", Group::Input, "*"},
    HelpRow{"fields", Group::Input, "*"},
    HelpRow{"textures", Group::Input, "*"},
    HelpRow{"keep-strays", Group::Input, ""},
    HelpRow{"source-root", Group::Input, ""},
    HelpRow{"path", Group::Input, "*"},
    HelpRow{"frames", Group::Input, "bench"},

    HelpRow{"kind", Group::View, "*"},
    HelpRow{"storey", Group::View, "*"},
    HelpRow{"eye-height", Group::View, "*"},
    HelpRow{"size", Group::View, "*"},
    HelpRow{"view", Group::View, kOfViews},
    HelpRow{"camera", Group::View, kOfViews},
    HelpRow{"eye", Group::View, kOfViews},
    HelpRow{"target", Group::View, kOfViews},
    HelpRow{"turntable", Group::View, "*"},
    HelpRow{"up", Group::View, ""},
    HelpRow{"fov-y", Group::View, "table"},
    HelpRow{"aspect", Group::View, "table"},
    HelpRow{"table near", Group::View, "*"},
    HelpRow{"table far", Group::View, "*"},
    HelpRow{"projection", Group::View, ""},
    HelpRow{"time", Group::View, ""},
    HelpRow{"section", Group::View, ""},
    HelpRow{"section-casters", Group::View, ""},

    HelpRow{"at", Group::Light, "*"},
    HelpRow{"from", Group::Light, "*"},
    HelpRow{"to", Group::Light, "*"},
    HelpRow{"step", Group::Light, "*"},
    HelpRow{"position time", Group::Light, "*"},
    HelpRow{"height", Group::Light, "*"},
    HelpRow{"pressure", Group::Light, "*"},
    HelpRow{"temperature", Group::Light, "*"},
    HelpRow{"sun", Group::Light, "render view explain"},
    HelpRow{"north", Group::Light, ""},
    HelpRow{"light", Group::Light, "render view explain table"},
    HelpRow{"sky", Group::Light, "render"},
    HelpRow{"shading", Group::Light, "render view"},
    HelpRow{"background", Group::Light, "render"},
    HelpRow{"ground", Group::Light, "render"},
    HelpRow{"color-by", Group::Light, "render view"},
    HelpRow{"colormap", Group::Light, ""},
    HelpRow{"color-range", Group::Light, ""},
    HelpRow{"light-at", Group::Light, ""},
    HelpRow{"sun-angle", Group::Light, ""},
    HelpRow{"light-error", Group::Light, ""},
    HelpRow{"ambient", Group::Light, ""},
    HelpRow{"overlay", Group::Light, ""},

    HelpRow{"triangles", Group::Quality, "*"},
    HelpRow{"seed", Group::Quality, "make"},
    HelpRow{"error", Group::Quality, "export"},
    HelpRow{"cuts", Group::Quality, "*"},
    HelpRow{"shadows", Group::Quality, "render view explain bench"},
    HelpRow{"error-pixels", Group::Quality, "render view explain bench"},
    HelpRow{"samples", Group::Quality, "render view"},
    HelpRow{"target-ms", Group::Quality, "*"},
    HelpRow{"backend", Group::Quality, "render view bench"},
    HelpRow{"shadow-texels", Group::Quality, ""},
    HelpRow{"filter", Group::Quality, ""},
    HelpRow{"max-triangles", Group::Quality, ""},
    HelpRow{"repetitions", Group::Quality, "*"},
    HelpRow{"warmup", Group::Quality, ""},
    HelpRow{"quick", Group::Quality, "*"},
    HelpRow{"no-wait", Group::Quality, ""},

    HelpRow{"oracle", Group::Compare, "bench"},
    HelpRow{"baseline", Group::Compare, "*"},
    HelpRow{"fail-above", Group::Compare, "*"},
    HelpRow{"against", Group::Compare, "*"},
    HelpRow{"against-model", Group::Compare, ""},
    HelpRow{"work-above", Group::Compare, ""},
    HelpRow{"undecided", Group::Compare, ""},
    HelpRow{"other-machine", Group::Compare, ""},
    HelpRow{"verdict", Group::Compare, ""},
    HelpRow{"budget-ms", Group::Compare, "*"},
    HelpRow{"max-wrong-pixels", Group::Compare, ""},
    HelpRow{"reference", Group::Compare, ""},
    HelpRow{"reference-threshold", Group::Compare, ""},

    HelpRow{"output", Group::Output, "*"},
    HelpRow{"format", Group::Output, "*"},
    HelpRow{"geodetic", Group::Output, "*"},
    HelpRow{"uncompressed", Group::Output, "*"},
    HelpRow{"report", Group::Output, "*"},
    HelpRow{"csv", Group::Output, "bench hours measure"},
    HelpRow{"json-file", Group::Output, "*"},
    HelpRow{"summary-md", Group::Output, ""},
    HelpRow{"bmf", Group::Output, ""},
    HelpRow{"action-json", Group::Output, ""},
    HelpRow{"json", Group::Output, "*"},
    HelpRow{"pfm", Group::Output, "*"},
    HelpRow{"images", Group::Output, ""},
    HelpRow{"all-images", Group::Output, ""},
    HelpRow{"stats", Group::Output, ""},
    HelpRow{"depth", Group::Output, ""},

    HelpRow{"memory", Group::Program, "build export"},
    HelpRow{"gpu-memory", Group::Program, ""},
    HelpRow{"build-memory", Group::Program, ""},
    HelpRow{"tmp", Group::Program, "*"},
    HelpRow{"resume", Group::Program, "*"},
    HelpRow{"in-memory", Group::Program, ""},
    HelpRow{"cacert", Group::Program, ""},
    HelpRow{"http-cache", Group::Program, ""},
    HelpRow{"shaders", Group::Program, ""},
    HelpRow{"threads", Group::Program, ""},
    HelpRow{"progress", Group::Program, ""},
    HelpRow{"version", Group::Program, "*"},
    HelpRow{"help", Group::Program, ""},
    HelpRow{"help-all", Group::Program, ""},

    HelpRow{"shadow-maps", Group::Research, ""},
    HelpRow{"z-partitions", Group::Research, ""},
    HelpRow{"face-partitions", Group::Research, ""},
    HelpRow{"split-lambda", Group::Research, ""},
    HelpRow{"empty-slices", Group::Research, ""},
    HelpRow{"warp", Group::Research, ""},
    HelpRow{"eta", Group::Research, ""},
    HelpRow{"tsm-focus", Group::Research, ""},
    HelpRow{"max-aliasing", Group::Research, ""},
    HelpRow{"shadow-near", Group::Research, ""},
    HelpRow{"shadow-far", Group::Research, ""},
    HelpRow{"near-floor", Group::Research, ""},
    HelpRow{"stabilize", Group::Research, ""},
    HelpRow{"cull-casters", Group::Research, ""},
    HelpRow{"occlusion", Group::Research, ""},
    HelpRow{"shadow-classes", Group::Research, ""},
    HelpRow{"shadow-depth", Group::Research, ""},
    HelpRow{"cluster-triangles", Group::Research, ""},
    HelpRow{"chunk-triangles", Group::Research, ""},
    HelpRow{"simplifier", Group::Research, ""},
    HelpRow{"max-stuck", Group::Research, ""},
};

/// Returns true if the blank-separated list `words` contains `word`.
bool contains(std::string_view words, std::string_view word) {
    return (" " + std::string(words) + " ").find(" " + std::string(word) + " ") != std::string::npos;
}

std::size_t rankOf(std::string_view option) {
    std::size_t rank = 0;
    while (rank < kRows.size() && kRows[rank].option != option)
        ++rank;
    return rank;
}

} // namespace

std::span<const HelpRow> helpTable() {
    return kRows;
}

HelpPlace helpPlace(std::string_view command, std::string_view option) {
    std::size_t rank = rankOf(std::string(command) + " " + std::string(option));
    if (rank == kRows.size()) rank = rankOf(option);
    GNOMON_CHECK(rank < kRows.size());
    const HelpRow& row = kRows[rank];
    const bool isEveryday = row.everyday == "*" || contains(row.everyday, command);
    const Tier others = row.group == Group::Research ? Tier::Research : Tier::Other;
    return {row.group, isEveryday ? Tier::Everyday : others, rank};
}

} // namespace gnomon::settings
