// Builds a model of a mesh, cuts it, draws it, and lists the cheapest shadow maps of one frustum.
//     cut_and_shadow MESH.ply MODEL.gnm PICTURE.ppm
#include <cstdio>
#include <exception>
#include <fstream>

#include <gnomon/gnomon.h>

int main(int argc, char** argv) {
    if (argc != 4) return std::fprintf(stderr, "usage: cut_and_shadow MESH.ply MODEL.gnm PICTURE.ppm\n"), 2;
    try {
        gnomon::api::build({argv[1]}, argv[2]);
        const gnomon::api::Model model(argv[2]);
        const gnomon::api::Mesh mesh = model.cutByTriangles(1000);
        std::printf("cut: %zu triangles, off by at most %g\n", mesh.triangles.size() / 3, mesh.error);

        const gnomon::api::Picture picture = model.render({{"size", "320x240"}, {"shadows", "exact"}}, 1);
        std::ofstream file(argv[3], std::ios::binary);
        file << "P6 " << picture.width << ' ' << picture.height << " 255\n";
        for (std::size_t i = 0; i < picture.pixels.size(); i += 4)
            file.write(reinterpret_cast<const char*>(&picture.pixels[i]), 3);

        for (const gnomon::api::ShadowScheme& scheme : gnomon::api::shadowSchemes(1, 1000, 60, 1, {0.3, 0.9, 0.2}))
            if (scheme.maps <= 4 && scheme.storageFactor < 20)
                std::printf(
                    "%-8s %-6s %d maps: %.3g texels a pixel\n",
                    scheme.scheme.c_str(),
                    scheme.warp.c_str(),
                    scheme.maps,
                    scheme.storageFactor);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
