#include "telemetry/frame_row.h"

#include "core/error.h"
#include "telemetry/json_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

namespace gnomon::telemetry {

namespace {

template <class T>
Value toValue(const T& value) {
    return Value(value);
}

template <class T>
Value toValue(const std::optional<T>& value) {
    return value ? Value(*value) : Value();
}

template <auto Member>
Value read(const FrameRow& row) {
    return toValue(row.*Member);
}

template <auto Member>
constexpr Column column(std::string_view name) {
    return {name, read<Member>};
}

template <class Number>
std::string shortest(Number number) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    return {text.data(), end};
}

std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"') result += '"';
        result += c;
    }
    return result + "\"";
}

struct CsvCell {
    std::string operator()(std::monostate /*nothing*/) const { return {}; }

    std::string operator()(bool value) const { return value ? "on" : "off"; }

    std::string operator()(std::int64_t value) const { return shortest(value); }

    std::string operator()(double value) const { return std::isfinite(value) ? shortest(value) : std::string(); }

    std::string operator()(const std::string& value) const { return quoted(value); }
};

struct JsonCell {
    nlohmann::ordered_json operator()(std::monostate /*nothing*/) const { return nullptr; }

    nlohmann::ordered_json operator()(double value) const {
        if (!std::isfinite(value)) return nullptr;
        return value;
    }

    template <class T>
    nlohmann::ordered_json operator()(const T& value) const {
        return value;
    }
};

using R = FrameRow;

/// All columns of the log, in their order in the file.
constexpr std::array kColumns = {
    column<&R::run>("run"),
    column<&R::repetition>("repetition"),
    column<&R::model>("model"),
    column<&R::frame>("frame"),
    column<&R::timeS>("time_s"),
    column<&R::scheme>("scheme"),
    column<&R::warp>("warp"),
    column<&R::zPartitions>("z_partitions"),
    column<&R::facePartitions>("face_partitions"),
    column<&R::stabilize>("stabilize"),
    column<&R::filter>("filter"),
    column<&R::shadowMaps>("shadow_maps"),
    column<&R::shadowMapsDrawn>("shadow_maps_drawn"),
    column<&R::cullCasters>("cull_casters"),
    column<&R::shadowTexels>("shadow_texels"),
    column<&R::errorPixels>("error_pixels"),
    column<&R::width>("width"),
    column<&R::height>("height"),
    column<&R::backend>("backend"),
    column<&R::planMs>("plan_ms"),
    column<&R::selectMs>("select_ms"),
    column<&R::cullMs>("cull_ms"),
    column<&R::streamMs>("stream_ms"),
    column<&R::shadowMs>("shadow_ms"),
    column<&R::imageMs>("image_ms"),
    column<&R::totalMs>("total_ms"),
    column<&R::imageTriangles>("image_triangles"),
    column<&R::shadowTriangles>("shadow_triangles"),
    column<&R::shadowFragments>("shadow_fragments"),
    column<&R::castersTested>("casters_tested"),
    column<&R::castersKept>("casters_kept"),
    column<&R::drawCalls>("draw_calls"),
    column<&R::residentBytes>("resident_bytes"),
    column<&R::gpuBytes>("gpu_bytes"),
    column<&R::bytesRead>("bytes_read"),
    column<&R::pagesMissing>("pages_missing"),
    column<&R::pagesDamaged>("pages_damaged"),
    column<&R::achievedErrorPixels>("achieved_error_pixels"),
    column<&R::near>("near"),
    column<&R::far>("far"),
    column<&R::depthRatio>("depth_ratio"),
    column<&R::lightAngle>("light_angle"),
    column<&R::storageFactor>("storage_factor"),
    column<&R::aliasingBoundX>("promised_aliasing_x"),
    column<&R::aliasingBoundZ>("promised_aliasing_z"),
    column<&R::measuredAliasing>("measured_aliasing"),
    column<&R::isBoundKept>("promise_kept"),
    column<&R::wrongShadowFraction>("wrong_shadow_fraction"),
    column<&R::shadowEdgeP99Px>("shadow_edge_p99_px"),
    column<&R::imageDifference>("image_difference"),
    column<&R::crawl>("crawl"),
    column<&R::sinceStartMs>("since_start_ms"),
    column<&R::missedShadowFraction>("missed_shadow_fraction"),
    column<&R::unexplainedShadowFraction>("unexplained_shadow_fraction"),
    column<&R::shadows>("shadows"),
    column<&R::shadowSamples>("shadow_samples"),
    column<&R::shadowCells>("shadow_cells"),
    column<&R::sampleTests>("sample_tests"),
    column<&R::exactDecisions>("exact_decisions"),
    column<&R::pixelsWithinTolerance>("touching_pixels"),
    column<&R::occlusion>("occlusion"),
    column<&R::clustersHidden>("clusters_hidden"),
    column<&R::wrongPixelsAll>("wrong_pixels_all"),
    column<&R::imageWidthDrawn>("image_width_drawn"),
    column<&R::samplesPerPixel>("samples_per_pixel"),
    column<&R::sunAngle>("sun_angle"),
    column<&R::lightError>("light_error"),
    column<&R::trianglesSetUp>("triangles_set_up"),
    column<&R::pagesRead>("pages_read"),
};

} // namespace

std::span<const Column> columns() {
    return kColumns;
}

std::string csvHeader() {
    std::string line;
    for (const Column& column : columns()) {
        if (!line.empty()) line += ',';
        line += column.name;
    }
    return line;
}

std::string csvRow(const FrameRow& row) {
    std::string line;
    bool first = true;
    for (const Column& column : columns()) {
        if (!first) line += ',';
        first = false;
        line += std::visit(CsvCell{}, column.value(row));
    }
    return line;
}

std::string jsonObject(const FrameRow& row) {
    nlohmann::ordered_json object;
    for (const Column& column : columns())
        object[std::string(column.name)] = std::visit(JsonCell{}, column.value(row));
    return jsonText(object, 2);
}

} // namespace gnomon::telemetry
