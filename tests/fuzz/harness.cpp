#include "harness.h"

#include "core/error.h"
#include "preprocess/read/open_mesh_sources.h"
#include "preprocess/read/polygon.h"

#include <fstream>

#include <unistd.h>

namespace gnomon::fuzz {

namespace {

constexpr Bytes kMemory = mebibytes(64);
constexpr std::uint64_t kMostPlaces = 3;       // vertices whose places are asked for, each a pass over the file
constexpr std::uint64_t kMostKept = 1U << 16U; // vertices that are kept for the polygons

void readWhole(read::MeshSource& source) {
    NoProgress progress;
    source.pollWith(progress);
    std::vector<glm::dvec3> positions;
    source.readVertices([&](const read::VertexBlock& block) {
        if (positions.size() < kMostKept)
            positions.insert(positions.end(), block.positions.begin(), block.positions.end());
    });
    read::PolygonRefiner refiner(progress);
    source.readTriangles([&](const read::TriangleBlock& block) {
        std::vector<read::TriangleCorners> triangles(block.triangles.begin(), block.triangles.end());
        for (const read::PolygonRun& run : block.polygons) {
            const auto fan = std::span(triangles).subspan(run.first, run.count);
            bool isKept = true;
            for (const read::TriangleCorners& triangle : fan)
                for (const std::uint64_t corner : triangle)
                    isKept = isKept && corner < positions.size();
            if (isKept) refiner.refine(fan, [&](std::uint64_t vertex) { return positions[vertex]; });
        }
    });
    for (std::uint64_t vertex = 0; vertex < std::min<std::uint64_t>(positions.size(), kMostPlaces); ++vertex)
        static_cast<void>(source.whereIs(vertex)); // as messages about a vertex say
    source.requireUnchanged();
}

} // namespace

InputFile::InputFile(const std::string& suffix)
    : path_(
          (std::filesystem::temp_directory_path() / ("gnomon_fuzz_" + std::to_string(::getpid()) + suffix)).string()) {}

InputFile::~InputFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

const std::string& InputFile::with(std::span<const std::uint8_t> bytes) {
    std::ofstream(path_, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path_;
}

void readMesh(const std::string& path) {
    const auto readAs = [](const std::vector<std::string>& paths, const std::vector<std::string>& fields) {
        try {
            const auto source = read::openMeshSources(paths, kMemory, fields);
            readWhole(*source);
            return true;
        } catch (const Error&) { // refused in words
            return false;
        }
    };
    if (readAs({path}, {})) readAs({path, path}, {"quality"});
}

} // namespace gnomon::fuzz
