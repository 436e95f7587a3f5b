#include "viewer/framed_model.h"

#include "path/outline.h"
#include "settings/resolve.h"
#include "settings/sun_settings.h"

#include <algorithm>

namespace gnomon::viewer {

FramedModel::FramedModel(const settings::Settings& settings, const hierarchy::ModelFile& model)
    : settings_(settings::uprightIn(settings, model)), summary_(model.summary()), outline_(path::outlineOf(model)) {}

plan::View FramedModel::view(settings::Settings settings, const glm::ivec2& size) const {
    settings.imageSize = {std::max(size.x, 1), std::max(size.y, 1)};
    return settings::viewOf(settings, summary_, outline_);
}

Camera FramedModel::home(const glm::ivec2& size, Projection projection) const {
    settings::Settings settings = settings_;
    settings.projection = projection;
    return view(settings, size).camera;
}

Camera FramedModel::from(path::ViewSide side, const glm::ivec2& size, Projection projection) const {
    settings::Settings settings = settings_;
    settings.projection = projection;
    settings.camera.reset();
    settings.eye = settings.target = std::nullopt;
    settings.side = side;
    return view(settings, size).camera;
}

std::optional<plan::PointLight> FramedModel::pointLight(const settings::Settings& asked) const {
    return settings::pointLightOf(asked, summary_);
}

void FramedModel::enter(Walk& walk, settings::Settings& asked, const glm::ivec2& size) const {
    const plan::View first = home(size);
    walk.enter(first.camera, first.up);
    if (!asked.isLightGiven) asked.towardsLight = first.towardsLight;
}

} // namespace gnomon::viewer
