#include "telemetry/frame_row.h"

#include "telemetry/json_text.h"

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

/// All columns in their order.
constexpr std::array kColumns = {
    Column{"run", read<&R::run>},
    Column{"repetition", read<&R::repetition>},
    Column{"model", read<&R::model>},
    Column{"frame", read<&R::frame>},
    Column{"time_s", read<&R::timeS>},
    Column{"scheme", read<&R::scheme>},
    Column{"warp", read<&R::warp>},
    Column{"z_partitions", read<&R::zPartitions>},
    Column{"face_partitions", read<&R::facePartitions>},
    Column{"stabilize", read<&R::stabilize>},
    Column{"filter", read<&R::filter>},
    Column{"shadow_maps", read<&R::shadowMaps>},
    Column{"shadow_maps_drawn", read<&R::shadowMapsDrawn>},
    Column{"cull_casters", read<&R::cullCasters>},
    Column{"shadow_texels", read<&R::shadowTexels>},
    Column{"error_pixels", read<&R::errorPixels>},
    Column{"width", read<&R::width>},
    Column{"height", read<&R::height>},
    Column{"backend", read<&R::backend>},
    Column{"plan_ms", read<&R::planMs>},
    Column{"select_ms", read<&R::selectMs>},
    Column{"cull_ms", read<&R::cullMs>},
    Column{"stream_ms", read<&R::streamMs>},
    Column{"shadow_ms", read<&R::shadowMs>},
    Column{"image_ms", read<&R::imageMs>},
    Column{"total_ms", read<&R::totalMs>},
    Column{"image_triangles", read<&R::imageTriangles>},
    Column{"shadow_triangles", read<&R::shadowTriangles>},
    Column{"shadow_fragments", read<&R::shadowFragments>},
    Column{"casters_tested", read<&R::castersTested>},
    Column{"casters_kept", read<&R::castersKept>},
    Column{"draw_calls", read<&R::drawCalls>},
    Column{"resident_bytes", read<&R::residentBytes>},
    Column{"gpu_bytes", read<&R::gpuBytes>},
    Column{"bytes_read", read<&R::bytesRead>},
    Column{"pages_missing", read<&R::pagesMissing>},
    Column{"pages_damaged", read<&R::pagesDamaged>},
    Column{"achieved_error_pixels", read<&R::achievedErrorPixels>},
    Column{"near", read<&R::near>},
    Column{"far", read<&R::far>},
    Column{"depth_ratio", read<&R::depthRatio>},
    Column{"light_angle", read<&R::lightAngle>},
    Column{"storage_factor", read<&R::storageFactor>},
    Column{"promised_aliasing_x", read<&R::promisedAliasingX>},
    Column{"promised_aliasing_z", read<&R::promisedAliasingZ>},
    Column{"measured_aliasing", read<&R::measuredAliasing>},
    Column{"promise_kept", read<&R::promiseKept>},
    Column{"wrong_shadow_fraction", read<&R::wrongShadowFraction>},
    Column{"shadow_edge_p99_px", read<&R::shadowEdgeP99Px>},
    Column{"image_difference", read<&R::imageDifference>},
    Column{"crawl", read<&R::crawl>},
    Column{"since_start_ms", read<&R::sinceStartMs>},
    Column{"missed_shadow_fraction", read<&R::missedShadowFraction>},
    Column{"unexplained_shadow_fraction", read<&R::unexplainedShadowFraction>},
    Column{"shadows", read<&R::shadows>},
    Column{"shadow_samples", read<&R::shadowSamples>},
    Column{"shadow_cells", read<&R::shadowCells>},
    Column{"sample_tests", read<&R::sampleTests>},
    Column{"exact_decisions", read<&R::exactDecisions>},
    Column{"touching_pixels", read<&R::touchingPixels>},
    Column{"predicted_sample_tests", read<&R::predictedSampleTests>},
    Column{"occlusion", read<&R::occlusion>},
    Column{"clusters_hidden", read<&R::clustersHidden>},
    Column{"wrong_pixels_all", read<&R::wrongPixelsAll>},
    Column{"image_width_drawn", read<&R::imageWidthDrawn>},
    Column{"samples_per_pixel", read<&R::samplesPerPixel>},
    Column{"sun_angle", read<&R::sunAngle>},
    Column{"light_error", read<&R::lightError>},
    Column{"triangles_set_up", read<&R::trianglesSetUp>},
    Column{"refined_cast_triangles", read<&R::refinedCastTriangles>},
    Column{"refined_sample_tests", read<&R::refinedSampleTests>},
};

} // namespace

const std::vector<Column>& columns() {
    static const std::vector<Column> table(kColumns.begin(), kColumns.end());
    return table;
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
