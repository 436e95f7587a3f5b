#include "preprocess/make/model_file.h"

#include "core/check.h"
#include "core/error.h"
#include "core/file.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <vector>

namespace gnomon::make {

namespace {

static_assert(std::endian::native == std::endian::little, "positions are written as they lie in memory");
static_assert(sizeof(glm::vec3) == 12);

constexpr std::uint64_t kVertexBytes = sizeof(glm::vec3);
constexpr std::uint64_t kTriangleBytes = 1 + 3 * sizeof(std::uint32_t);

/// A buffered writer of one contiguous region of a file.
class RegionWriter {
public:
    RegionWriter(File& file, std::uint64_t offset) : file_(file), offset_(offset) {
        buffer_.reserve(kWriteBuffer.count);
    }

    /// Returns a buffer for the next `size` bytes (at most kWriteBuffer). The caller must fill it before the next call.
    std::byte* room(std::size_t size) {
        if (buffer_.size() + size > kWriteBuffer.count) flush();
        const std::size_t at = buffer_.size();
        buffer_.resize(at + size);
        return buffer_.data() + at;
    }

    void flush() {
        file_.writeAt(offset_, buffer_);
        offset_ += buffer_.size();
        buffer_.clear();
    }

private:
    File& file_;
    std::uint64_t offset_;
    std::vector<std::byte> buffer_;
};

/// Writes the vertices and triangles of one block to two regions of the PLY file.
class FileSink final : public MeshSink {
public:
    FileSink(File& file, std::uint64_t vertexOffset, std::uint64_t triangleOffset)
        : vertices_(file, vertexOffset), triangles_(file, triangleOffset) {}

    void addVertices(std::span<const glm::vec3> positions) override {
        constexpr std::size_t kPiece = 4096;
        for (std::size_t first = 0; first < positions.size(); first += kPiece) {
            const auto piece = positions.subspan(first, std::min(kPiece, positions.size() - first));
            std::memcpy(vertices_.room(piece.size_bytes()), piece.data(), piece.size_bytes());
        }
        size_.vertices += positions.size();
    }

    void addTriangles(std::span<const MadeTriangle> triangles) override {
        for (const MadeTriangle& triangle : triangles) {
            std::byte* out = triangles_.room(kTriangleBytes);
            out[0] = std::byte{3};
            const std::array<std::uint32_t, 3> corners{
                static_cast<std::uint32_t>(triangle[0]),
                static_cast<std::uint32_t>(triangle[1]),
                static_cast<std::uint32_t>(triangle[2])};
            std::memcpy(out + 1, corners.data(), sizeof corners);
        }
        size_.triangles += triangles.size();
    }

    MeshSize finish() {
        vertices_.flush();
        triangles_.flush();
        return size_;
    }

private:
    RegionWriter vertices_;
    RegionWriter triangles_;
    MeshSize size_;
};

std::string headerText(const MeshSize& size, const std::string& comment) {
    const bool fitsInt = size.vertices <= static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max());
    return "ply\nformat binary_little_endian 1.0\ncomment " + comment + "\nelement vertex " +
           std::to_string(size.vertices) + "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
           std::to_string(size.triangles) + "\nproperty list uchar " + (fitsInt ? "int" : "uint") +
           " vertex_indices\nend_header\n";
}

} // namespace

MeshSize modelSize(const MadeModel& model) {
    MeshSize sum;
    for (std::size_t block = 0; block < model.blockCount(); ++block)
        sum += model.blockSize(block);
    return sum;
}

MeshSize writeMadeModel(
    const MadeModel& model, const std::string& path, const std::string& comment, int threads, Progress& progress) {
    // Numbers of vertices and triangles in all blocks before each block.
    std::vector<MeshSize> before(model.blockCount());
    MeshSize size;
    for (std::size_t block = 0; block < before.size(); ++block) {
        before[block] = size;
        size += model.blockSize(block);
    }
    if (size.vertices > std::numeric_limits<std::uint32_t>::max())
        throw Error(
            path,
            "too many vertices for the 32-bit indices of a PLY",
            "at most 4294967295",
            std::to_string(size.vertices));
    const std::string header = headerText(size, comment);
    const std::uint64_t vertexOffset = header.size();
    const std::uint64_t triangleOffset = vertexOffset + size.vertices * kVertexBytes;

    AtomicFile output(path);
    output.file().writeAt(0, std::as_bytes(std::span(header)));
    progress.stage("make", "triangles", size.triangles);
    const auto writeBlock = [&](std::size_t block) {
        FileSink sink(
            output.file(),
            vertexOffset + before[block].vertices * kVertexBytes,
            triangleOffset + before[block].triangles * kTriangleBytes);
        model.makeBlock(block, before[block].vertices, sink);
        const MeshSize made = sink.finish();
        const MeshSize planned = model.blockSize(block);
        GNOMON_CHECK_OP(made.vertices, ==, planned.vertices);
        GNOMON_CHECK_OP(made.triangles, ==, planned.triangles);
        progress.advance(made.triangles);
    };
    const int cores = tbb::this_task_arena::max_concurrency();
    // The number of threads is at most the number of cores, because TBB prints a warning for more threads.
    tbb::task_arena arena(threads > 0 ? std::min(threads, cores) : cores);
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, before.size(), writeBlock); });
    output.commit();
    return size;
}

} // namespace gnomon::make
