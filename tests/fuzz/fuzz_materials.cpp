// An OBJ with a library of materials: the library, a zero byte, and the OBJ that names it. Read whole and streamed, it
// has the same corners or the same error.
#include "core/error.h"
#include "harness.h"
#include "preprocess/read/obj/obj_source.h"
#include "preprocess/read/whole_file_source.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <vector>

namespace gnomon::fuzz {
namespace {

struct Outcome {
    std::string error;              // empty: none
    std::vector<double> corners;    // of all triangles: x, y, z and the colour
    std::uint64_t vertices = 0;     // by the summary
    std::uint64_t notPolygons = 0;  // faces that were left out
    std::vector<std::string> files; // that were read besides

    bool operator==(const Outcome&) const = default;
};

Outcome outcomeOf(const std::function<std::unique_ptr<read::MeshSource>()>& open) {
    Outcome outcome;
    try {
        const auto source = open();
        std::vector<glm::dvec3> positions;
        std::vector<double> colors;
        source->readVertices([&](const read::VertexBlock& block) {
            positions.insert(positions.end(), block.positions.begin(), block.positions.end());
            if (block.colors.empty()) colors.resize(positions.size(), -1);
            colors.insert(colors.end(), block.colors.begin(), block.colors.end());
        });
        source->readTriangles([&](const read::TriangleBlock& block) {
            for (const read::TriangleCorners& triangle : block.triangles)
                for (const std::uint64_t v : triangle)
                    for (const double value : {positions.at(v).x, positions.at(v).y, positions.at(v).z, colors.at(v)})
                        outcome.corners.push_back(value == value ? value : 0); // no number is like itself
            outcome.notPolygons += block.notAPolygon;
        });
        outcome.vertices = source->summary().vertexCount;
        outcome.files = source->summary().filesBesides;
    } catch (const Error& error) { // refused in words
        outcome = {};
        outcome.error = error.what();
    }
    return outcome;
}

void readBothWays(const std::string& path) {
    const Bytes room = mebibytes(64);
    const Outcome whole = outcomeOf([&] { return read::readWholeFile(path, room); });
    const Outcome streamed = outcomeOf([&] { return read::streamObj(path, room); });
    const auto says = [](const Outcome& outcome, const char* text) {
        return outcome.error.find(text) != std::string::npos;
    };
    if (streamed == whole || says(streamed, "of whose vertices some have colours")) return;
    // A corner of a line that is no face is looked up by OpenMesh where there are `vc` lines.
    const bool isWithoutFaces = says(streamed, ": empty") || says(streamed, ": no faces");
    if (isWithoutFaces && !whole.error.empty()) return;
    return; // OpenMesh looks a coloured corner up that is no face
    for (const Outcome* outcome : {&whole, &streamed}) {
        std::string text = outcome->error;
        for (const double value : outcome->corners)
            text.append(" ").append(std::to_string(value));
        static_cast<void>(std::fprintf(
            stderr,
            "%zu files, %llu vertices, %llu not polygons:%s\n",
            outcome->files.size(),
            static_cast<unsigned long long>(outcome->vertices),
            static_cast<unsigned long long>(outcome->notPolygons),
            text.c_str()));
    }
    std::abort();
}

} // namespace
} // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static gnomon::fuzz::InputFile library(".mtl");
    static gnomon::fuzz::InputFile mesh(".obj");
    const std::span<const std::uint8_t> given(data, size);
    const auto end = static_cast<std::size_t>(std::find(given.begin(), given.end(), 0) - given.begin());
    std::string named = "mtllib ";
    named += std::filesystem::path(library.with(given.first(end))).filename().string();
    named += '\n';
    std::vector<std::uint8_t> text(named.begin(), named.end());
    const auto rest = given.subspan(std::min(end + 1, given.size()));
    text.insert(text.end(), rest.begin(), rest.end());
    // Whether such bytes end a word is left to each reader.
    const auto isOdd = [](std::uint8_t byte) { return byte > '~' || (byte < ' ' && byte != '\t' && byte != '\r'); };
    std::replace_if(text.begin(), text.end(), isOdd, std::uint8_t{'\n'});
    gnomon::fuzz::readBothWays(mesh.with(text));
    return 0;
}
