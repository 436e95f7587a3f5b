// Seeded triples of camera, light and scheme for any model. All validations of shadows use them.
#pragma once

#include "core/box.h"
#include "plan/frame_plan.h"

#include <cstdint>
#include <string>

namespace gnomon::tests {

/// A view and a quality for one validation.
struct ShadowTriple {
    plan::View view;
    plan::Quality quality;
};

/// Returns triple `index`. Eyes are far away, at eye height among the parts of the model, or close above it. Lights
/// range from vertical to the horizon, and include the view direction. All warps occur, with slices, faces, filters and
/// stabilised slices. The image has `side` x `side` pixels, and the maps `texels` x `texels` texels. Equal bounds give
/// equal triples on each machine.
ShadowTriple shadowTriple(const Box& bounds, std::uint64_t index, int side, int texels);

/// Returns a point light for the view of triple `index`: within the model, at a corner of its box, on the floor of the
/// box, at the eye, or outside, up to 10^6 model sizes away.
plan::PointLight lampFor(const Box& bounds, const plan::View& view, std::uint64_t index);

/// Returns the camera and the light of `triple` with the default quality.
ShadowTriple withDefaults(const ShadowTriple& triple);

/// Returns a short description of the triple's scheme for messages.
std::string describe(const ShadowTriple& triple);

} // namespace gnomon::tests
