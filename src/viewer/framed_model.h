// The views that the window offers of a model: where it begins, and the model framed from its sides.
#pragma once

#include "hierarchy/model_file.h"
#include "settings/settings.h"
#include "viewer/walk.h"

#include <vector>

namespace gnomon::viewer {

/// Of one model and of the options that the window was opened with.
class FramedModel {
public:
    /// Reads the model's outline. Throws Error.
    FramedModel(const settings::Settings& settings, const hierarchy::ModelFile& model);

    /// The view that was asked for, in a picture of `size` pixels (at least 1); it frames the model where nothing else
    /// was. Throws Error for a camera file that is none.
    plan::View home(const glm::ivec2& size) const { return view(settings_, size); }

    /// Its camera with another projection.
    Camera home(const glm::ivec2& size, Projection projection) const;

    /// The camera of such a picture that has the model framed from a side.
    Camera from(path::ViewSide side, const glm::ivec2& size, Projection projection) const;

    const Box& bounds() const { return summary_.bounds; }

    /// What is up in the model's world.
    glm::dvec3 up() const { return settings_.up.value_or(summary_.up.direction); }

    /// The lamp that `asked` asks for.
    std::optional<plan::PointLight> pointLight(const settings::Settings& asked) const;

    /// Begins `walk` at home, and lights it as its up asks for where nobody gave `asked` a light. Throws Error as home
    /// does; then nothing has changed.
    void enter(Walk& walk, settings::Settings& asked, const glm::ivec2& size) const;

private:
    plan::View view(settings::Settings settings, const glm::ivec2& size) const;

    settings::Settings settings_;
    hierarchy::ModelSummary summary_;
    std::vector<glm::dvec3> outline_;
};

} // namespace gnomon::viewer
