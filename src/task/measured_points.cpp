#include "task/measured_points.h"

#include "core/error.h"
#include "core/formatted.h"
#include "frame/drawn_point.h"
#include "inspect/cells.h"
#include "settings/resolve.h"
#include "task/session.h"

#include <cmath>

namespace gnomon::task {

namespace {

inspect::Point givenPoint(const glm::dvec3& point, const hierarchy::Grid& grid) {
    const glm::i64vec3 cell = inspect::cellOf(grid, point);
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(cell[axis]) > inspect::kMaxSteps / 2)
            throw Error(
                formatted("point %g,%g,%g", point.x, point.y, point.z),
                "too far from the model",
                formatted("at most %g away", std::ldexp(grid.step(), 39)),
                formatted("%g", glm::distance(point, grid.origin)));
    return {cell, grid.snapError()};
}

/// Returns the surface points that the pixels of `task` show. Draws the view without shadows, because shadows do not
/// move points.
inspect::Measure shownPoints(const PointTask& task, Session& session) {
    plan::Quality quality = settings::qualityOf(task.settings);
    quality.shadows = plan::ShadowMode::Off;
    const frame::FrameOptions options;
    const frame::Frame frame =
        session.renderer().render(settings::viewOf(task.settings, session.model()), quality, options);
    session.tellShortfall();
    inspect::Measure measure;
    for (const glm::ivec2& pixel : task.pixels) {
        const auto drawn = frame::drawnPoint(session.renderer(), frame, options, pixel);
        if (!drawn)
            throw Error(
                formatted("pixel %d,%d", pixel.x, pixel.y),
                "no surface is visible in this pixel",
                "a surface",
                "background");
        const frame::GridPlace place = task.takesVertices ? drawn->vertex.value_or(drawn->point) : drawn->point;
        measure.push_back({place.cell, place.within});
    }
    return measure;
}

} // namespace

MeasuredPoints measurePoints(const PointTask& task) {
    MeasuredPoints result;
    const auto take = [&](const hierarchy::ModelFile& model) {
        const settings::Settings upright = settings::uprightIn(task.settings, model);
        result.of = inspect::surveyedOf(task.model, model.summary(), upright.up.value_or(model.summary().up.direction));
    };
    if (task.pixels.empty()) { // without pixels, nothing is drawn and no backend is needed
        take(hierarchy::ModelFile(task.model, task.settings.memory));
        for (const glm::dvec3& point : task.points)
            result.measure.push_back(givenPoint(point, result.of.grid));
        return result;
    }
    Session session(task.model, task.settings, task.warn);
    take(session.model());
    result.measure = shownPoints(task, session);
    return result;
}

} // namespace gnomon::task
