// Computes the standard cameras of a model in the window: the first view, and the views from its sides.
#pragma once

#include "hierarchy/model_file.h"
#include "settings/settings.h"
#include "viewer/walk.h"

#include <vector>

namespace gnomon::viewer {

/// Computes the standard views of one model, with the options that the user gave to the window.
class FramedModel {
public:
    /// Reads points of the surface of `model`, which standard views must show. Throws Error.
    FramedModel(const settings::Settings& settings, const hierarchy::ModelFile& model);

    /// Returns the first view of the model for an image of `size` pixels (at least 1). If the user requests no camera,
    /// the view shows the whole model. Throws Error for an invalid camera file.
    plan::View home(const glm::ivec2& size) const { return view(settings_, size); }

    /// Returns the camera of the first view, with its projection changed to `projection`.
    Camera home(const glm::ivec2& size, Projection projection) const;

    /// Returns a camera that sees the whole model from `side`.
    Camera from(path::ViewSide side, const glm::ivec2& size, Projection projection) const;

    const Box& bounds() const { return summary_.bounds; }

    /// Returns the up direction of the model's world.
    glm::dvec3 up() const { return settings_.up.value_or(summary_.up.direction); }

    /// Returns the point light that `asked` requests, or nullopt if it requests none.
    std::optional<plan::PointLight> pointLight(const settings::Settings& asked) const;

    /// Moves the camera of `walk` to the first view of the model. If `asked` requests no light, sets its light to the
    /// default for the up direction. Throws Error in the same cases as `home`, and then changes nothing.
    void enter(Walk& walk, settings::Settings& asked, const glm::ivec2& size) const;

private:
    plan::View view(settings::Settings settings, const glm::ivec2& size) const;

    settings::Settings settings_;
    hierarchy::ModelSummary summary_;
    std::vector<glm::dvec3> outline_;
};

} // namespace gnomon::viewer
