#include "inspect/seen_values.h"

#include "core/error.h"
#include "hierarchy/page_fields.h"
#include "settings/backend_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace gnomon::inspect {

namespace {

/// A pixel of the image, the triangle that it shows, and the weights of the triangle's vertices there.
struct SeenPixel {
    std::size_t pixel = 0;
    render::SeenTriangle triangle;
    std::array<double, 3> weights{};
};

/// Returns the barycentric weights of the point in the triangle's plane that is nearest to `point`. Negative weights
/// become 0, because pictures round positions within a pixel.
std::array<double, 3> weightsAt(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& point) {
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    std::array<double, 3> weights{1, 0, 0}; // used for a triangle without area
    double sum = 0;
    if (glm::dot(normal, normal) > 0) {
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3& a = corners[(i + 1) % 3];
            const glm::dvec3& b = corners[(i + 2) % 3];
            weights[i] = std::max(glm::dot(normal, glm::cross(b - a, point - a)), 0.0);
            sum += weights[i];
        }
        for (double& weight : weights)
            weight = sum > 0 ? weight / sum : 1.0 / 3;
    }
    return weights;
}

/// Calls `take` with a SeenPixel for each pixel that shows a triangle of the model.
template <class Take>
void eachSeen(const frame::Renderer& renderer, const frame::Frame& frame, const Take& take) {
    const render::Raster<render::SeenTriangle> seen = renderer.backend().seenTriangles();
    if (seen.pixels.empty())
        throw Error(
            "colours by vertex, error or field",
            settings::onlySoftware(&plan::Capabilities::seesTriangles),
            "software",
            renderer.backend().name());
    const render::Raster<render::SurfaceSample> surfaces = renderer.backend().surfaces();
    const hierarchy::ResidentPages resident = renderer.residency().resident();
    const hierarchy::GridPoint& origin = frame.space.originCell;
    for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
        const render::SeenTriangle& triangle = seen.pixels[i];
        if (triangle.page == hierarchy::kNone || !(surfaces.pixels[i].isSurface > 0)) continue;
        std::array<glm::dvec3, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const hierarchy::GridPoint& p = resident[triangle.page]->vertices[triangle.vertices[k]].position;
            corners[k] = (glm::dvec3(p.x, p.y, p.z) - glm::dvec3(origin.x, origin.y, origin.z)) * frame.space.step;
        }
        take(SeenPixel{i, triangle, weightsAt(corners, glm::dvec3(surfaces.pixels[i].position))});
    }
}

ValuePicture noValues(const frame::Frame& frame) {
    const plan::View& view = frame.plan.view;
    return {view.width, view.height, std::numeric_limits<double>::quiet_NaN()};
}

/// Returns the index of the model's field with this name. Throws Error with the known names if the field does not
/// exist.
std::size_t fieldNamed(const hierarchy::ModelFile& model, const std::string& name) {
    const std::vector<hierarchy::Field>& fields = model.summary().fields;
    const auto found =
        std::find_if(fields.begin(), fields.end(), [&](const hierarchy::Field& field) { return field.name == name; });
    if (found != fields.end()) return static_cast<std::size_t>(found - fields.begin());
    std::string known = "none, vertex, height, slope, error";
    for (const hierarchy::Field& field : fields)
        known += ", " + field.name;
    throw Error(
        model.path(),
        "the model has no such value for colours; a build stores only the fields that were requested",
        "one of " + known,
        "'" + name + "'");
}

} // namespace

ValuePicture seenErrors(const frame::Renderer& renderer, const frame::Frame& frame) {
    ValuePicture values = noValues(frame);
    const hierarchy::ResidentPages resident = renderer.residency().resident();
    const double finest = renderer.model().summary().grid.snapError();
    eachSeen(renderer, frame, [&](const SeenPixel& seen) {
        const hierarchy::Page& page = *resident[seen.triangle.page];
        const std::uint32_t refinement = page.clusters[seen.triangle.cluster].refinement;
        values.pixels[seen.pixel] = refinement == hierarchy::kNone ? finest : page.refinements[refinement].error;
    });
    return values;
}

ValuePicture seenField(const frame::Renderer& renderer, const frame::Frame& frame, const std::string& name) {
    const hierarchy::ModelFile& model = renderer.model();
    const std::size_t which = fieldNamed(model, name);
    const hierarchy::Field& field = model.summary().fields[which];
    ValuePicture values = noValues(frame);
    std::map<std::uint32_t, hierarchy::PageFields> pages; // read again, because a frame does not store fields
    eachSeen(renderer, frame, [&](const SeenPixel& seen) {
        const auto [entry, isNew] = pages.try_emplace(seen.triangle.page);
        hierarchy::PageFields& fields = entry->second;
        if (isNew) (void)model.readPage(seen.triangle.page, fields);
        double number = 0;
        for (std::size_t k = 0; k < 3; ++k)
            number += seen.weights[k] * fields.layout.number(fields.words[seen.triangle.vertices[k]], which);
        values.pixels[seen.pixel] = field.min + number * (field.max - field.min) / fields.layout.maxNumber(which);
    });
    return values;
}

render::Picture seenColors(const frame::Renderer& renderer, const frame::Frame& frame) {
    const hierarchy::ModelFile& model = renderer.model();
    if (!model.summary().hasColors)
        throw Error(model.path(), "the model stores no vertex colours", "a source with colours", "none");
    render::Picture colors(frame.plan.view.width, frame.plan.view.height);
    const hierarchy::ResidentPages resident = renderer.residency().resident();
    eachSeen(renderer, frame, [&](const SeenPixel& seen) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            double level = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t color = resident[seen.triangle.page]->vertices[seen.triangle.vertices[k]].color;
                level += seen.weights[k] * static_cast<double>(color >> (8 * channel) & 0xFFU);
            }
            colors.pixels[seen.pixel][channel] = static_cast<std::uint8_t>(std::lround(level));
        }
    });
    return colors;
}

} // namespace gnomon::inspect
