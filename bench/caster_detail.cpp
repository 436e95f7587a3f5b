// Measures how many pixels change if shadow casters outside the view have a lower level of detail.
//
// usage: caster_detail MODEL.gnm TRIPLES [SIDE] [TEXELS]
//
// The program draws TRIPLES seeded views with seeded lights, each one twice. First, casters outside the view frustum
// have the planned level of detail. Then these casters have full detail. Images have SIDE x SIDE pixels (default: 800).
// The shadow maps have TEXELS x TEXELS texels in total (default: 2048).
//
// The program prints a table with one row:
// - pictures: number of views with casters outside the view; other views are skipped
// - wrong pixels: pixels with a colour channel that differs by more than 2 of 255 levels; mean and max over the views
// - off-screen triangles: triangles of planned off-screen casters, in percent of these triangles at full detail
//
// The exit code is 1 if no view has casters outside the view.
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
    std::vector<double> wrong; // wrong pixels of each view, in percent
    double planned = 0;
    double full = 0;
    for (int i = 0; i < triples; ++i) {
        const auto triple = gnomon::tests::withDefaults(
            gnomon::tests::shadowTriple(model.summary().bounds, static_cast<std::uint64_t>(i), side, texels));
        const auto found = gnomon::tests::casterDifference(model, triple.view, triple.quality);
        if (found.fullOffScreenTriangles == 0) continue; // the view has no casters outside of it
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
