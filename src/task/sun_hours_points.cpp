#include "task/sun_hours_points.h"

#include "core/error.h"
#include "core/formatted.h"
#include "core/prepared_output.h"
#include "core/random.h"
#include "inspect/cells.h"
#include "preprocess/exporter/ply_writer.h"
#include "settings/codec.h"
#include "settings/resolve.h"
#include "settings/sun_period.h"
#include "sun/point_receivers.h"
#include "task/sun_hours_run.h"
#include "task/text_runs.h"

#include <charconv>
#include <cmath>

namespace gnomon::task {

namespace {

constexpr Bytes kMaxPointBytes{std::uint64_t{1} << 28U};

/// Returns the point at the beginning of a CSV line, or nullopt if the line does not begin with three numbers.
std::optional<glm::dvec3> pointOf(std::string_view line) {
    glm::dvec3 point;
    const char* at = line.data();
    const char* end = line.data() + line.size();
    for (int axis = 0; axis < 3; ++axis) {
        while (at != end && (*at == ' ' || *at == '\t'))
            ++at;
        const auto [next, failure] = std::from_chars(at, end, point[axis]);
        if (failure != std::errc() || !std::isfinite(point[axis])) return std::nullopt;
        at = next;
        while (at != end && (*at == ' ' || *at == '\t' || *at == '\r'))
            ++at;
        if (axis < 2 && (at == end || *at++ != ',')) return std::nullopt;
    }
    return at == end || *at == ',' ? std::optional(point) : std::nullopt;
}

/// Reads the points of a CSV file whose lines begin with x,y,z. The first line can be a header. Throws Error for
/// another line without three numbers.
std::vector<glm::dvec3> readPoints(const std::string& path) {
    const std::string text = readTextFile(path, kMaxPointBytes);
    std::vector<glm::dvec3> points;
    std::uint64_t number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = std::string_view(text).substr(begin, end - begin);
        begin = end + 1;
        ++number;
        if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
        if (const auto point = pointOf(line))
            points.push_back(*point);
        else if (number > 1)
            throw Error(
                atLine(path, number),
                "this line is not a point",
                "three numbers x,y,z between commas",
                std::string(line.substr(0, 40)));
    }
    if (points.empty()) throw Error(path, "the file has no points", "lines that begin with x,y,z", "none");
    return points;
}

void writePointRows(const std::string& path, const std::vector<glm::dvec3>& points, const SunHoursRun& run) {
    TextRuns out(path);
    out.put(std::string("x,y,z,") + kSunHoursColumns + "\n");
    for (std::size_t i = 0; i < points.size(); ++i)
        out.put(textOf(points[i]) + "," + run.row(i) + "\n");
    out.commit();
}

void writeVertices(
    const std::string& path,
    const exporter::CutMesh& mesh,
    const hierarchy::ModelSummary& summary,
    const sun::LitSteps& lit,
    const SunHoursRun& run,
    Progress& progress) {
    std::array<exporter::VertexValues, 2> values = {
        exporter::VertexValues{"hours", {}}, exporter::VertexValues{"steps", {}}};
    for (const std::uint32_t count : lit.count) {
        values[0].values.push_back(static_cast<float>(run.hours(count)));
        values[1].values.push_back(static_cast<float>(count));
    }
    exporter::writePly(mesh, summary, values, path, progress);
}

std::uint64_t cellSum(const std::vector<glm::i64vec3>& cells) {
    std::uint64_t sum = cells.size();
    for (const glm::i64vec3& cell : cells)
        for (int axis = 0; axis < 3; ++axis)
            sum = mix64(sum ^ static_cast<std::uint64_t>(cell[axis]));
    return sum;
}

/// Returns the section planes in steps of the grid if sections also cut shadow casters, and otherwise an empty list.
std::vector<Plane> cutsOfCasters(const plan::View& view, const hierarchy::Grid& grid) {
    std::vector<Plane> planes;
    if (view.cutsCasters)
        for (const Plane& plane : view.sections)
            planes.push_back({plane.normal, plane.signedDistance(grid.origin) / grid.step()});
    return planes;
}

} // namespace

std::optional<SunHoursSummary> computePointHours(const SunHoursTask& task, Progress& progress) {
    settings::requirePointHours(task.settings);
    const hierarchy::ModelFile model(task.model, task.settings.memory);
    const hierarchy::ModelSummary& summary = model.summary();
    const std::vector<glm::dvec3> points = task.points.empty() ? std::vector<glm::dvec3>() : readPoints(task.points);
    const settings::Settings upright = settings::uprightIn(task.settings, model);
    plan::View view;
    settings::setSections(task.settings, view);
    std::vector<sun::SunStep> steps = stepsOf(task, upright.up.value_or(summary.up.direction));
    if (task.team->leads())
        for (const std::string& path : {task.output, task.csv})
            requireWritable(path);
    exporter::ExportLimit limit;
    limit.error = task.error.value_or(summary.grid.snapError());
    exporter::UniformCut cut = exporter::uniformCut(model, limit, progress);
    exporter::CutMesh mesh;
    std::vector<glm::i64vec3> cells;
    if (task.isOfVertices) {
        mesh = cut.mesh;
        exporter::weld(mesh);
        for (const hierarchy::Vertex& vertex : mesh.vertices)
            cells.emplace_back(vertex.position.x, vertex.position.y, vertex.position.z);
    } else {
        for (const glm::dvec3& point : points)
            cells.push_back(inspect::cellOf(summary.grid, point));
    }
    SunHoursRun run(
        task,
        std::move(steps),
        formatted("points %016llx; error %.17g", static_cast<unsigned long long>(cellSum(cells)), *limit.error) +
            keyOfSections(view));
    sun::PointReceivers receivers(cut, std::move(cells), cutsOfCasters(view, summary.grid));
    const double error = cut.error;
    cut = {};
    const sun::LitSteps* const lit = run.decide(receivers, progress);
    if (lit == nullptr) return std::nullopt;
    if (task.isOfVertices)
        writeVertices(task.output, mesh, summary, *lit, run, progress);
    else
        writePointRows(task.csv, points, run);
    return run.finish(receivers.count(), formatted("%.3g of the model's units", error));
}

} // namespace gnomon::task
