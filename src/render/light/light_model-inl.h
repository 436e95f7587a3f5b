// The SIMD version of light_model.h: computes the light and the displayed colour of surfaces. The operations have the
// same order. The header is compiled once per SIMD instruction set.
#if defined(GNOMON_RENDER_LIGHT_LIGHT_MODEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_RENDER_LIGHT_LIGHT_MODEL_INL_H
#undef GNOMON_RENDER_LIGHT_LIGHT_MODEL_INL_H
#else
#define GNOMON_RENDER_LIGHT_LIGHT_MODEL_INL_H
#endif

#include "render/light/light_model.h"
#include "render/vector_lanes-inl.h"

HWY_BEFORE_NAMESPACE();

namespace gnomon::render::HWY_NAMESPACE {

HWY_INLINE Floats polynomial(const std::array<float, 5>& k, Floats x) {
    auto value = hn::Add(constant(k[3]), hn::Mul(x, constant(k[4])));
    value = hn::Add(constant(k[2]), hn::Mul(x, value));
    value = hn::Add(constant(k[1]), hn::Mul(x, value));
    return hn::Add(constant(k[0]), hn::Mul(x, value));
}

HWY_INLINE Floats displayFromLinear(Floats linear) {
    return hn::IfThenElse(
        hn::Le(linear, constant(srgb::kLinearLimit)),
        hn::Mul(linear, constant(srgb::kLinearSlope)),
        polynomial(srgb::kToDisplay, hn::Sqrt(linear)));
}

HWY_INLINE Floats linearFromDisplay(Floats display) {
    return hn::IfThenElse(
        hn::Le(display, constant(srgb::kDisplayLimit)),
        hn::Mul(display, constant(1 / srgb::kLinearSlope)),
        polynomial(srgb::kFromDisplay, display));
}

HWY_INLINE Vec3 linearFromDisplay(const Vec3& display) {
    return {linearFromDisplay(display.x), linearFromDisplay(display.y), linearFromDisplay(display.z)};
}

HWY_INLINE Floats toneMapped(const block::Frame& frame, Floats light) {
    const auto shown = frame.isToneMapped != 0 ? hn::Div(light, hn::Add(constant(1), light)) : light;
    return hn::Min(shown, constant(1));
}

HWY_INLINE Vec3 reflected(const Vec3& albedo, const Vec3& light) {
    return {hn::Mul(albedo.x, light.x), hn::Mul(albedo.y, light.y), hn::Mul(albedo.z, light.z)};
}

/// Returns the displayed colour for linear light `light`, after tone mapping.
HWY_INLINE Vec3 displayed(const block::Frame& frame, const Vec3& light) {
    return {
        displayFromLinear(toneMapped(frame, light.x)),
        displayFromLinear(toneMapped(frame, light.y)),
        displayFromLinear(toneMapped(frame, light.z))};
}

/// Returns the light that a surface receives from all light sources except the sun.
HWY_INLINE Vec3 ambientLight(const block::Frame& frame, const Vec3& normal, const Vec3& eyeDirection) {
    const auto cosine = dot(normal, eyeDirection);
    const auto facing = hn::Mul(constant(frame.headlight), hn::Mul(cosine, cosine));
    const auto skyward = dot(normal, constant(&frame.skyAxis.x));
    const Vec3 ambient = add(constant(&frame.ambientMean.x), scale(constant(&frame.ambientTilt.x), skyward));
    return add(ambient, {facing, facing, facing});
}

} // namespace gnomon::render::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
