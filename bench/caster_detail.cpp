// What caster detail saves and what it costs: seeded poses and lights, the plan's casters against full detail.
// usage: caster_detail MODEL.gnm TRIPLES [SIDE] [TEXELS]
#include "tests/frame/full_casters.h"
#include "tests/support/shadow_triples.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <vector>

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: caster_detail MODEL.gnm TRIPLES [SIDE] [TEXELS]\n");
        return 2;
    }
    const gnomon::hierarchy::ModelFile model(argv[1]);
    const int triples = std::atoi(argv[2]);
    const int side = argc > 3 ? std::atoi(argv[3]) : 800;
    const int texels = argc > 4 ? std::atoi(argv[4]) : 2048;
    std::vector<double> wrong;
    double planned = 0;
    double full = 0;
    for (int i = 0; i < triples; ++i) {
        const auto triple = gnomon::tests::withDefaults(
            gnomon::tests::shadowTriple(model.summary().bounds, static_cast<std::uint64_t>(i), side, texels));
        const auto found = gnomon::tests::casterDifference(model, triple.view, triple.quality);
        if (found.fullOffScreenTriangles == 0) continue; // nothing off screen casts into the view
        wrong.push_back(100 * found.wrongFraction);
        planned += static_cast<double>(found.offScreenTriangles);
        full += static_cast<double>(found.fullOffScreenTriangles);
    }
    std::printf("| pictures | wrong pixels, mean %% | worst %% | off-screen triangles in the maps, %% of all |\n");
    std::printf("|---|---|---|---|\n");
    if (wrong.empty()) return 1;
    std::printf(
        "| %zu | %.4f | %.4f | %.1f |\n",
        wrong.size(),
        std::accumulate(wrong.begin(), wrong.end(), 0.0) / static_cast<double>(wrong.size()),
        *std::max_element(wrong.begin(), wrong.end()),
        100 * planned / full);
    return 0;
}
