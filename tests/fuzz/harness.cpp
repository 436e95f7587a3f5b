#include "harness.h"

#include "core/error.h"
#include "preprocess/read/open_mesh_sources.h"
#include "preprocess/read/polygon.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>

#include <unistd.h>

namespace gnomon::fuzz {

namespace {

constexpr Bytes kMemory = mebibytes(64);
constexpr std::uint64_t kMaxPlaces = 3;       // vertices whose places are asked for, each a pass over the file
constexpr std::uint64_t kMaxKept = 1U << 16U; // vertices that are kept for the polygons

/// What was read, as hashes: in whichever blocks it came.
class Digest {
public:
    void add(const read::VertexBlock& block) {
        add(0, std::as_bytes(block.positions));
        add(1, std::as_bytes(block.colors));
        add(2, std::as_bytes(block.fields));
    }

    void add(const read::TriangleBlock& block) {
        add(3, std::as_bytes(block.triangles));
        notAPolygon_ += block.notAPolygon;
    }

    bool operator==(const Digest&) const = default;

private:
    void add(std::size_t channel, std::span<const std::byte> bytes) {
        std::uint64_t& hash = hashes_[channel];
        for (const std::byte byte : bytes)
            hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001B3U; // FNV-1a
    }

    std::array<std::uint64_t, 4> hashes_{};
    std::uint64_t notAPolygon_ = 0;
};

/// Nothing where ranges tell that only whole passes do.
std::optional<Digest> readRanges(read::MeshSource& source) {
    NoProgress progress;
    if (!source.indexRows(progress)) return std::nullopt;
    Digest digest;
    const auto inParts = [](std::uint64_t rows, const auto& read) {
        const std::uint64_t third = rows / 3;
        return read(0, third) && read(third, rows);
    };
    const auto readVertices = [&](std::uint64_t begin, std::uint64_t end) {
        source.readVertexRange(begin, end, [&](const read::VertexBlock& block) { digest.add(block); });
        return true;
    };
    const auto readFaces = [&](std::uint64_t begin, std::uint64_t end) {
        return source.readFaceRange(begin, end, [&](const read::TriangleBlock& block) { digest.add(block); });
    };
    inParts(source.summary().vertexCount, readVertices);
    if (!inParts(source.summary().faceCount, readFaces)) return std::nullopt;
    return digest;
}

Digest readWhole(read::MeshSource& source) {
    NoProgress progress;
    source.pollWith(progress);
    Digest digest;
    std::vector<glm::dvec3> positions;
    source.readVertices([&](const read::VertexBlock& block) {
        digest.add(block);
        if (positions.size() < kMaxKept)
            positions.insert(positions.end(), block.positions.begin(), block.positions.end());
    });
    read::PolygonRefiner refiner(progress);
    source.readTriangles([&](const read::TriangleBlock& block) {
        digest.add(block);
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
    for (std::uint64_t vertex = 0; vertex < std::min<std::uint64_t>(positions.size(), kMaxPlaces); ++vertex)
        static_cast<void>(source.whereIs(vertex)); // as messages about a vertex say
    source.requireUnchanged();
    return digest;
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
            std::optional<Digest> byRanges;
            if (source->summary().hasRanges) byRanges = readRanges(*source);
            const Digest whole = readWhole(*source);
            if (byRanges && *byRanges != whole) std::abort();
            return true;
        } catch (const Error&) { // refused in words
            return false;
        }
    };
    if (readAs({path}, {})) readAs({path, path}, {"quality"});
}

} // namespace gnomon::fuzz
