#include "inspect/measures.h"

#include "core/formatted.h"
#include "inspect/cells.h"
#include "telemetry/json_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace gnomon::inspect {

namespace {

using nlohmann::ordered_json;

std::vector<glm::i64vec3> cellsOf(const Measure& measure) {
    std::vector<glm::i64vec3> cells;
    cells.reserve(measure.size());
    for (const Point& point : measure)
        cells.push_back(point.cell);
    return cells;
}

/// Returns the shortest text of a number that reads back as exactly `value`.
std::string exactText(double value) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// Returns how many decimals distinguish two coordinates that are one grid step apart.
int digitsOf(const Surveyed& of) {
    return std::clamp(static_cast<int>(std::ceil(-std::log10(of.grid.step()))), 0, 9);
}

ordered_json pointJson(const Point& point, const Surveyed& of) {
    const glm::dvec3 at = worldOf(of.grid, point.cell);
    return {{"position", {at.x, at.y, at.z}}, {"within", point.within}};
}

ordered_json measureJson(const Measure& measure, const Surveyed& of) {
    const Figures figures = figuresOf(measure, of);
    ordered_json json;
    json["points"] = ordered_json::array();
    for (const Point& point : measure)
        json["points"].push_back(pointJson(point, of));
    json["legs"] = figures.legs;
    json["along"] = figures.along;
    json["straight"] = figures.straight;
    json["height"] = figures.height;
    json["level"] = figures.level;
    json["slope_degrees"] = figures.slopeDegrees;
    json["angles_degrees"] = ordered_json::array();
    for (const std::optional<double>& angle : figures.anglesDegrees)
        json["angles_degrees"].push_back(angle ? ordered_json(*angle) : ordered_json());
    if (measure.size() > 2) {
        json["perimeter"] = figures.perimeter;
        json["area"] = figures.area;
        json["plan_area"] = figures.planArea;
        json["off_plane"] = figures.offPlane;
    }
    return json;
}

/// Returns the CSV row of the last point of `measure`, which contains all points up to this one. `number` is the number
/// of the measurement.
std::string csvRow(std::size_t number, const Measure& measure, const Surveyed& of) {
    const Figures figures = figuresOf(measure, of);
    const glm::dvec3 at = worldOf(of.grid, measure.back().cell);
    std::string row = std::to_string(number) + "," + std::to_string(measure.size());
    const auto put = [&row](const std::optional<double>& value) { row += "," + (value ? exactText(*value) : ""); };
    for (const double value : {at.x, at.y, at.z, measure.back().within})
        put(value);
    const bool isLeg = measure.size() > 1;
    const bool isPolygon = measure.size() > 2;
    const auto putIf = [&put](bool isThere, double value) { put(isThere ? std::optional(value) : std::nullopt); };
    putIf(isLeg, isLeg ? figures.legs.back() : 0);
    for (const double value : {figures.along, figures.straight, figures.height, figures.level, figures.slopeDegrees})
        putIf(isLeg, value);
    put(isPolygon ? figures.anglesDegrees.back() : std::nullopt);
    for (const double value : {figures.perimeter, figures.area, figures.planArea, figures.offPlane})
        putIf(isPolygon, value);
    return row + "\n";
}

} // namespace

Surveyed surveyedOf(const std::string& path, const hierarchy::ModelSummary& model, const glm::dvec3& up) {
    return {path, model.grid, model.unit, up};
}

Figures figuresOf(const Measure& measure, const Surveyed& of) {
    return figuresOf(cellsOf(measure), of.grid.step(), of.up);
}

std::vector<std::string> inWords(const Measure& measure, const Surveyed& of) {
    std::vector<std::string> lines;
    if (measure.empty()) return lines;
    const int digits = digitsOf(of);
    const std::string unit(hierarchy::rowOf(of.unit).name);
    const auto length = [&](double value) { return formatted("%.*f ", digits, value) + unit; };
    const glm::dvec3 at = worldOf(of.grid, measure.back().cell);
    lines.push_back(
        formatted("point %zu: %.*f, %.*f, %.*f", measure.size(), digits, at.x, digits, at.y, digits, at.z) +
        ", within " + length(measure.back().within));
    if (measure.size() < 2) return lines;
    const Figures figures = figuresOf(measure, of);
    lines.push_back(
        "straight " + length(figures.straight) + ", within " + length(measure.front().within + measure.back().within));
    if (measure.size() > 2)
        lines.push_back("along " + length(figures.along) + ", last leg " + length(figures.legs.back()));
    lines.push_back(
        "height " + length(figures.height) + ", level " + length(figures.level) +
        formatted(", slope %.4f degrees", figures.slopeDegrees));
    if (measure.size() < 3) return lines;
    if (const std::optional<double>& angle = figures.anglesDegrees.back())
        lines.push_back(formatted("angle %.4f degrees at point %zu", *angle, measure.size() - 1));
    lines.push_back(
        "area " + length(figures.area) + "\u00b2, on plan " + length(figures.planArea) + "\u00b2, perimeter " +
        length(figures.perimeter));
    if (figures.offPlane > of.grid.step())
        lines.push_back("its points lie up to " + length(figures.offPlane) + " off its plane");
    return lines;
}

std::string jsonOf(std::span<const Measure> measures, const Surveyed& of) {
    const glm::dvec3 up = glm::normalize(of.up);
    ordered_json json = {
        {"model", of.model},
        {"unit", hierarchy::rowOf(of.unit).name},
        {"grid_step", of.grid.step()},
        {"up", {up.x, up.y, up.z}}};
    json["measures"] = ordered_json::array();
    for (const Measure& measure : measures)
        json["measures"].push_back(measureJson(measure, of));
    return telemetry::jsonText(json, 1) + "\n";
}

std::string csvOf(std::span<const Measure> measures, const Surveyed& of) {
    std::string text = "measure,point,x,y,z,within,leg,along,straight,height,level,slope_degrees,angle_degrees,"
                       "perimeter,area,plan_area,off_plane\n";
    for (std::size_t i = 0; i < measures.size(); ++i)
        for (std::size_t count = 1; count <= measures[i].size(); ++count) {
            const auto end = measures[i].begin() + static_cast<std::ptrdiff_t>(count);
            text += csvRow(i + 1, Measure(measures[i].begin(), end), of);
        }
    return text;
}

} // namespace gnomon::inspect
