#include "path/outline.h"

#include "core/angle.h"
#include "hierarchy/coarse_cut.h"
#include "hierarchy/cut_rule.h"
#include "hierarchy/main_part.h"

#include <array>
#include <cmath>

namespace gnomon::path {

namespace {

bool contains(const Box& box, const glm::dvec3& point) {
    return glm::all(glm::lessThanEqual(box.min, point)) && glm::all(glm::lessThanEqual(point, box.max));
}

/// Adds vertices of a page to the outline of a model. They are those inside `part` whose clusters have the level of
/// detail for the error limit `error`.
void addVertices(
    const hierarchy::Page& page,
    const hierarchy::Grid& grid,
    double error,
    const Box& part,
    std::vector<glm::dvec3>& points) {
    const auto isRefined = [error](double groupError, const Sphere&) { return groupError > error; };
    hierarchy::forEachDrawn(page, isRefined, [&](const hierarchy::Group&, const hierarchy::Cluster& cluster) {
        for (std::uint32_t v = cluster.firstVertex; v < cluster.firstVertex + cluster.vertexCount; ++v)
            if (const glm::dvec3 point = grid.world(page.vertices[v].position); contains(part, point))
                points.push_back(point);
    });
}

double coarseErrorOf(const hierarchy::ModelFile& model) {
    return hierarchy::coarseError(
        std::array{model.pages()}, glm::length(hierarchy::mainPartOf(model.summary()).extent()));
}

} // namespace

std::vector<glm::dvec3> cornersOf(const Box& box) {
    const Box solid = box.isEmpty() ? Box{glm::dvec3(0), glm::dvec3(0)} : box;
    std::vector<glm::dvec3> corners;
    corners.reserve(8);
    for (int corner = 0; corner < 8; ++corner)
        corners.emplace_back(
            (corner & 1) != 0 ? solid.max.x : solid.min.x,
            (corner & 2) != 0 ? solid.max.y : solid.min.y,
            (corner & 4) != 0 ? solid.max.z : solid.min.z);
    return corners;
}

std::vector<glm::dvec3> outlineOf(const hierarchy::ModelFile& model) {
    const hierarchy::ModelSummary& summary = model.summary();
    const double error = coarseErrorOf(model);
    const Box part = hierarchy::mainPartOf(summary);
    std::vector<glm::dvec3> points;
    for (std::uint32_t id = 0; id < model.pages().size(); ++id) {
        const hierarchy::PageInfo& info = model.pages()[id];
        if (!hierarchy::isDrawnOf(info, error)) continue;
        try {
            addVertices(model.readPage(id), summary.grid, error, part, points);
        } catch (const hierarchy::PageDamage&) {
            const Box local = summary.grid.local(info.box);
            const std::vector<glm::dvec3> corners = cornersOf(
                {glm::max(local.min + summary.grid.origin, part.min),
                 glm::min(local.max + summary.grid.origin, part.max)});
            points.insert(points.end(), corners.begin(), corners.end());
        }
    }
    return points.empty() ? cornersOf(part) : points;
}

hierarchy::UpGuess guessedUp(const hierarchy::ModelFile& model) {
    const Box part = hierarchy::mainPartOf(model.summary());
    const double error = hierarchy::upError(std::array{model.pages()}, glm::length(part.extent()));
    hierarchy::UpSurvey survey(model.summary().grid, part);
    for (std::uint32_t id = 0; id < model.pages().size(); ++id)
        if (hierarchy::isDrawnOf(model.pages()[id], error)) survey.add(model.readPage(id), error);
    return survey.guess();
}

std::vector<glm::dvec3> sweptOutline(
    const std::vector<glm::dvec3>& outline, const glm::dvec3& center, const glm::dvec3& up) {
    constexpr int kTurns = 48; // the deviation from a circle is at most 1/400 of its radius
    const glm::dvec3 axis = glm::normalize(up);
    std::vector<glm::dvec3> points;
    points.reserve(outline.size() * kTurns);
    for (int turn = 0; turn < kTurns; ++turn) {
        const double cosine = std::cos(2 * kPi * turn / kTurns);
        const double sine = std::sin(2 * kPi * turn / kTurns);
        for (const glm::dvec3& point : outline) {
            const glm::dvec3 from = point - center;
            const glm::dvec3 along = axis * glm::dot(axis, from);
            points.push_back(center + along + (from - along) * cosine + glm::cross(axis, from) * sine);
        }
    }
    return points;
}

} // namespace gnomon::path
