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

} // namespace

const std::vector<Column>& columns() {
    using R = FrameRow;
    static const std::vector<Column> table = {
        {"run", read<&R::run>},
        {"repetition", read<&R::repetition>},
        {"model", read<&R::model>},
        {"frame", read<&R::frame>},
        {"time_s", read<&R::timeS>},
        {"scheme", read<&R::scheme>},
        {"warp", read<&R::warp>},
        {"z_partitions", read<&R::zPartitions>},
        {"face_partitions", read<&R::facePartitions>},
        {"stabilize", read<&R::stabilize>},
        {"filter", read<&R::filter>},
        {"shadow_maps", read<&R::shadowMaps>},
        {"shadow_maps_drawn", read<&R::shadowMapsDrawn>},
        {"cull_casters", read<&R::cullCasters>},
        {"shadow_texels", read<&R::shadowTexels>},
        {"error_pixels", read<&R::errorPixels>},
        {"width", read<&R::width>},
        {"height", read<&R::height>},
        {"backend", read<&R::backend>},
        {"plan_ms", read<&R::planMs>},
        {"select_ms", read<&R::selectMs>},
        {"cull_ms", read<&R::cullMs>},
        {"stream_ms", read<&R::streamMs>},
        {"shadow_ms", read<&R::shadowMs>},
        {"image_ms", read<&R::imageMs>},
        {"total_ms", read<&R::totalMs>},
        {"image_triangles", read<&R::imageTriangles>},
        {"shadow_triangles", read<&R::shadowTriangles>},
        {"shadow_fragments", read<&R::shadowFragments>},
        {"casters_tested", read<&R::castersTested>},
        {"casters_kept", read<&R::castersKept>},
        {"draw_calls", read<&R::drawCalls>},
        {"resident_bytes", read<&R::residentBytes>},
        {"gpu_bytes", read<&R::gpuBytes>},
        {"bytes_read", read<&R::bytesRead>},
        {"pages_missing", read<&R::pagesMissing>},
        {"pages_damaged", read<&R::pagesDamaged>},
        {"achieved_error_pixels", read<&R::achievedErrorPixels>},
        {"near", read<&R::near>},
        {"far", read<&R::far>},
        {"depth_ratio", read<&R::depthRatio>},
        {"light_angle", read<&R::lightAngle>},
        {"storage_factor", read<&R::storageFactor>},
        {"promised_aliasing_x", read<&R::promisedAliasingX>},
        {"promised_aliasing_z", read<&R::promisedAliasingZ>},
        {"measured_aliasing", read<&R::measuredAliasing>},
        {"promise_kept", read<&R::promiseKept>},
        {"wrong_shadow_fraction", read<&R::wrongShadowFraction>},
        {"shadow_edge_p99_px", read<&R::shadowEdgeP99Px>},
        {"image_difference", read<&R::imageDifference>},
        {"crawl", read<&R::crawl>},
        {"since_start_ms", read<&R::sinceStartMs>},
        {"missed_shadow_fraction", read<&R::missedShadowFraction>},
        {"unexplained_shadow_fraction", read<&R::unexplainedShadowFraction>},
        {"shadows", read<&R::shadows>},
        {"shadow_samples", read<&R::shadowSamples>},
        {"shadow_cells", read<&R::shadowCells>},
        {"sample_tests", read<&R::sampleTests>},
        {"exact_decisions", read<&R::exactDecisions>},
        {"touching_pixels", read<&R::touchingPixels>},
        {"predicted_sample_tests", read<&R::predictedSampleTests>},
        {"occlusion", read<&R::occlusion>},
        {"clusters_hidden", read<&R::clustersHidden>},
        {"wrong_pixels_all", read<&R::wrongPixelsAll>},
        {"image_width_drawn", read<&R::imageWidthDrawn>},
        {"samples_per_pixel", read<&R::samplesPerPixel>},
        {"sun_angle", read<&R::sunAngle>},
        {"light_error", read<&R::lightError>},
    };
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
