#include "validation/shadow_classes.h"

#include "render/exact_pass.h"

#include <algorithm>

namespace gnomon::validation {

namespace {

ShadowClass trueClass(const render::SurfaceSample& surface, std::uint8_t status) {
    if (status == render::kNoSample) return surface.isSurface > 0 ? ShadowClass::FacesAway : ShadowClass::Background;
    if (status == exact::kLit) return ShadowClass::Lit;
    return (status & exact::kDark) != 0 ? ShadowClass::Dark : ShadowClass::WithinTolerance;
}

} // namespace

render::Raster<ShadowClass> drawnClasses(const render::Raster<render::SurfaceSample>& surfaces) {
    render::Raster<ShadowClass> classes(surfaces.width, surfaces.height);
    std::transform(
        surfaces.pixels.begin(), surfaces.pixels.end(), classes.pixels.begin(), [](const render::SurfaceSample& each) {
            if (each.isSurface <= 0) return ShadowClass::Background;
            if (!each.isLitSide()) return ShadowClass::FacesAway;
            return each.litFraction() >= 0.5F ? ShadowClass::Lit : ShadowClass::Dark;
        });
    return classes;
}

render::Raster<ShadowClass> trueClasses(
    const render::Raster<render::SurfaceSample>& surfaces, const render::Raster<std::uint8_t>& statuses) {
    render::Raster<ShadowClass> classes(surfaces.width, surfaces.height);
    std::transform(
        surfaces.pixels.begin(), surfaces.pixels.end(), statuses.pixels.begin(), classes.pixels.begin(), trueClass);
    return classes;
}

render::Picture pictureOf(const render::Raster<ShadowClass>& classes) {
    render::Picture picture(classes.width, classes.height);
    std::transform(classes.pixels.begin(), classes.pixels.end(), picture.pixels.begin(), [](ShadowClass each) {
        const auto level = static_cast<std::uint8_t>(each);
        return render::Rgb{level, level, level};
    });
    return picture;
}

} // namespace gnomon::validation
