// Seeded triples of pose, light and scheme for any model: what every proof about shadows runs over.
#pragma once

#include "core/box.h"
#include "plan/frame_plan.h"

#include <cstdint>
#include <string>

namespace gnomon::tests {

/// One picture to prove something about.
struct ShadowTriple {
    plan::View view;
    plan::Quality quality;
};

/// Triple `index`: eyes far out, at eye height among the model's parts and close above it; lights from straight down to
/// the horizon and along the view; every warp, with slices, faces, filters and stabilised slices. `side` pixels, and
/// `texels` on each side of the budget. The same bounds give the same triples on any machine.
ShadowTriple shadowTriple(const Box& bounds, std::uint64_t index, int side, int texels);

/// A lamp for the view of triple `index`: within the model, at a corner of its box, on the box's floor, at the eye, or
/// outside, up to 10^6 sizes away.
plan::PointLight lampFor(const Box& bounds, const plan::View& view, std::uint64_t index);

/// The pose and the light of triple `index`, drawn with the default settings.
ShadowTriple withDefaults(const ShadowTriple& triple);

/// The triple's scheme in short, for messages.
std::string describe(const ShadowTriple& triple);

} // namespace gnomon::tests
