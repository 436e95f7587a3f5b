#include "settings/plan_json.h"

#include "core/angle.h"
#include "settings/plan_sentences.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>

namespace gnomon::settings {

namespace {

using nlohmann::ordered_json;

/// Returns the matrix that transforms world space to the camera space of `plan`.
glm::dmat4 cameraFromWorld(const plan::FramePlan& plan) {
    const CameraBasis& basis = plan.basis;
    const glm::dvec3 eye = plan.view.camera.eye;
    return glm::transpose(glm::dmat4(
        glm::dvec4(basis.right, -glm::dot(basis.right, eye)),
        glm::dvec4(basis.up, -glm::dot(basis.up, eye)),
        glm::dvec4(basis.view, -glm::dot(basis.view, eye)),
        glm::dvec4(0, 0, 0, 1)));
}

/// Returns the matrix that transforms the clip space of the light, with depths in [0, 1], to that of OpenGL, with
/// depths in [-1, 1].
glm::dmat4 glClipFromLightClip() {
    glm::dmat4 clip(1);
    clip[2].z = 2;
    clip[3].z = -1;
    return clip;
}

ordered_json matrixJson(const glm::dmat4& matrix) {
    ordered_json numbers = ordered_json::array();
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            numbers.push_back(matrix[column][row]);
    return numbers;
}

ordered_json planesJson(const plan::FramePlan& plan, const ConvexVolume& volume) {
    ordered_json planes = ordered_json::array();
    for (const Plane& plane : volume.planes) {
        const glm::dvec3 normal = toWorld(plan.basis, plane.normal);
        const double offset = plane.offset - glm::dot(normal, plan.view.camera.eye);
        planes.push_back({normal.x, normal.y, normal.z, offset});
    }
    return planes;
}

ordered_json passJson(const plan::FramePlan& plan, const plan::ShadowPass& pass) {
    const shadow::ShadowMap& map = pass.map;
    const shadow::TexelRectangle& r = map.rectangle;
    ordered_json json;
    json["kind"] = "shadow_map";
    json["slice"] = map.region.slice;
    json["face"] = shadow::name(map.region.face);
    json["near"] = depthFromAskedEye(plan, map.region.frustum.near);
    json["far"] = depthFromAskedEye(plan, map.region.frustum.far);
    json["covered_near"] = depthFromAskedEye(plan, map.region.covered.near);
    json["covered_far"] = depthFromAskedEye(plan, map.region.covered.far);
    json["light_clip_from_world"] =
        matrixJson(glClipFromLightClip() * map.lightClipFromCamera() * cameraFromWorld(plan));
    json["rectangle"] = {r.x, r.y, r.width, r.height};
    json["kappa"] = map.warped.kappa;
    // In a logarithmic map, the row of a point is this factor times ln(w), counted from the lower edge of the
    // rectangle. w comes from the matrix. The value 0 means that rows are evenly spaced in y / w.
    json["rows_per_log"] = map.warped.rows == shadow::RowSpacing::Even ? 0.0 : map.rowsPerLog();
    json["promised_aliasing_x"] = map.aliasingBound.x;
    json["promised_aliasing_z"] = map.aliasingBound.z;
    json["promised_aliasing_z_sheared"] = map.aliasingBound.sheared;
    json["caster_planes"] = planesJson(plan, map.casterVolume);
    json["clamps_depth"] = pass.clampsDepth;
    json["estimated_triangles"] = pass.estimatedTriangles;
    json["reused"] = pass.isReused;
    return json;
}

std::string line(const char* format, ...) __attribute__((format(printf, 1, 2)));

std::string line(const char* format, ...) {
    std::array<char, 512> text{};
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text.data(), text.size(), format, arguments);
    va_end(arguments);
    return text.data();
}

} // namespace

ordered_json planJson(const plan::FramePlan& plan, const BackendChoice& backend) {
    ordered_json json;
    json["backend"] = wordOf(kBackends, backend.backend);
    json["backend_reason"] = backend.reason;
    json["projection"] = wordOf(kProjections, plan.view.camera.projection);
    json["near"] = depthFromAskedEye(plan, plan.near);
    json["far"] = depthFromAskedEye(plan, plan.far);
    json["near_from"] = sourceInWords(plan.nearFrom);
    json["far_from"] = sourceInWords(plan.farFrom);
    if (const auto& lamp = plan.view.pointLight) json["light_at"] = {lamp->at.x, lamp->at.y, lamp->at.z};
    json["light_angle"] = degreesFromRadians(plan.lightAngleRadians);
    json["promise_kept"] = plan.isBoundKept;
    json["scheme"] = plan::schemeName(plan);
    json["shadows"] = wordOf(plan::kShadowModes, plan.quality.shadows);
    json["shadows_because"] = reasonInWords(plan.shadowReason);
    json["light_directions"] = plan.penumbra.directions;
    json["penumbra_pixels"] = plan.penumbra.widestPixels;
    json["penumbra_tiles"] = plan.penumbra.tiles ? ordered_json(plan.penumbra.tiles->count()) : ordered_json(nullptr);
    json["sky_directions"] = plan.sky.directions;
    json["cost"] = plan.cost;
    json["passes"] = ordered_json::array();
    for (const plan::ShadowPass& pass : plan.passes)
        json["passes"].push_back(passJson(plan, pass));
    json["omitted"] = ordered_json::array();
    for (const plan::SkippedEffect& skipped : plan.omitted)
        json["omitted"].push_back({{"effect", effectInWords(skipped)}, {"reason", reasonInWords(skipped)}});
    json["texels_that_would_do"] = nullptr; // no maps, or no number of texels reaches the requested aliasing bound
    if (plan.requiredTexels > 0) json["texels_that_would_do"] = plan.requiredTexels;
    return json;
}

namespace {

/// Returns the max perspective aliasing over all shadow maps, and a table with one line per map.
std::string mapsText(const plan::FramePlan& plan) {
    const auto asked = [&](double depth) { return depthFromAskedEye(plan, depth); };
    std::string text;
    text += line(
        "aliasing bound x %.3g, z %.3g over [near, far]%s; %s texels would suffice for %g\n",
        plan.aliasingBound.x,
        plan.aliasingBound.z,
        plan.isBoundKept ? "" : ", which is NOT what was requested",
        plan.requiredTexels > 0 ? std::to_string(plan.requiredTexels).c_str() : "no number of",
        plan.quality.maxAliasing);
    text += line(
        "\n%-5s %-6s %10s %10s %22s %10s %9s %9s %9s %12s\n",
        "slice",
        "face",
        "near",
        "far",
        "texels",
        "kappa",
        "bound x",
        "z",
        "sheared",
        "triangles");
    for (const plan::ShadowPass& pass : plan.passes) {
        const shadow::ShadowMap& map = pass.map;
        const shadow::TexelRectangle& r = map.rectangle;
        text += line(
            "%-5zu %-6s %10.4g %10.4g %22s %10.4g %9.3g %9.3g %9.3g %12llu\n",
            map.region.slice,
            shadow::name(map.region.face),
            asked(map.region.frustum.near),
            asked(map.region.frustum.far),
            line("%dx%d at %d,%d", r.width, r.height, r.x, r.y).c_str(),
            map.warped.kappa,
            map.aliasingBound.x,
            map.aliasingBound.z,
            map.aliasingBound.sheared,
            static_cast<unsigned long long>(pass.estimatedTriangles));
    }
    const auto isLog = [](const plan::ShadowPass& pass) { return shadow::hasLogRows(pass.map.warped); };
    if (std::any_of(plan.passes.begin(), plan.passes.end(), isLog))
        text += "rows of warped maps are evenly spaced in the logarithm of w; the bound in z includes the shear\n";
    return text;
}

} // namespace

std::string planText(const plan::FramePlan& plan, const BackendChoice& backend) {
    const auto asked = [&](double depth) { return depthFromAskedEye(plan, depth); };
    std::string text = "backend " + std::string(wordOf(kBackends, backend.backend)) + ": " + backend.reason + "\n";
    if (plan.view.camera.isParallel())
        text += "orthographic: the limit of a small angle, so one density of texels for each slice and no warp\n";
    text += line("near   %-12g %s\n", asked(plan.near), sourceInWords(plan.nearFrom).c_str());
    text += line("far    %-12g %s\n", asked(plan.far), sourceInWords(plan.farFrom).c_str());
    if (plan.shown != DepthSpan{plan.near, plan.far})
        text += line(
            "shown  %g to %g: outside near and far there is no aliasing bound\n",
            asked(plan.shown.near),
            asked(plan.shown.far));
    if (const auto& lamp = plan.view.pointLight)
        text += line(
            "light  a point at %.6g, %.6g, %.6g, as bright as the sun at %.6g\n",
            lamp->at.x,
            lamp->at.y,
            lamp->at.z,
            lamp->reach);
    else
        text += line("light  %.2f degrees from the view\n", degreesFromRadians(plan.lightAngleRadians));
    text += line(
        "plan   %s: %zu maps in %dx%d texels, cost %llu\n",
        plan::schemeName(plan).c_str(),
        plan.passes.size(),
        plan.textureWidth,
        plan.textureHeight,
        static_cast<unsigned long long>(plan.cost));
    text += shadowsInWords(plan) + lightInWords(plan);
    if (!plan.passes.empty()) text += mapsText(plan);
    if (!plan.omitted.empty()) text += "\nleft out\n";
    for (const plan::SkippedEffect& skipped : plan.omitted)
        text += line("  %-18s %s\n", effectInWords(skipped).c_str(), reasonInWords(skipped).c_str());
    return text;
}

} // namespace gnomon::settings
