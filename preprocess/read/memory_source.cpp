#include "preprocess/read/memory_source.h"

#include "core/check.h"
#include "core/error.h"
#include "preprocess/read/block_buffers.h"

#include <algorithm>

namespace gnomon::read {

namespace {

class MemorySource final : public MeshSource {
public:
    MemorySource(const std::string& path, std::uint64_t fileBytes, MemoryMesh mesh) : mesh_(std::move(mesh)) {
        summary_.path = path;
        summary_.fileBytes = fileBytes;
        summary_.vertexCount = mesh_.positions.size();
        summary_.faceCount = mesh_.faceSizes.size();
        for (const std::uint32_t size : mesh_.faceSizes)
            summary_.likelyTriangles += size > 2 ? size - 2 : 0;
        summary_.hasNormals = !mesh_.normals.empty();
        summary_.hasColors = !mesh_.colors.empty();
        summary_.heldBytes = bytesOf(mesh_.positions) + bytesOf(mesh_.normals) + bytesOf(mesh_.colors) +
                             bytesOf(mesh_.faceSizes) + bytesOf(mesh_.corners) + bytesOf(mesh_.fields);
        summary_.fields = mesh_.fieldNames;
        GNOMON_CHECK(mesh_.fields.size() == summary_.fields.size() * mesh_.positions.size());
        GNOMON_CHECK(mesh_.normals.empty() || mesh_.normals.size() == mesh_.positions.size());
        GNOMON_CHECK(mesh_.colors.empty() || mesh_.colors.size() == mesh_.positions.size());
        const auto needsDouble = [](const glm::dvec3& p) { return glm::dvec3(glm::vec3(p)) != p; };
        summary_.isDouble = std::any_of(mesh_.positions.begin(), mesh_.positions.end(), needsDouble);
        summary_.attributesDropped = mesh_.attributesDropped;
        summary_.remarks = mesh_.remarks;
        requireFaces(summary_);
    }

    const MeshSummary& summary() const override { return summary_; }

    void readVertices(const VertexSink& sink) override {
        for (std::size_t first = 0; first < mesh_.positions.size(); first += kBlockRows) {
            const std::size_t count = std::min(kBlockRows, mesh_.positions.size() - first);
            VertexBlock block;
            block.firstVertex = first;
            block.positions = std::span(mesh_.positions).subspan(first, count);
            if (summary_.hasNormals) block.normals = std::span(mesh_.normals).subspan(first, count);
            if (summary_.hasColors) block.colors = std::span(mesh_.colors).subspan(first, count);
            const std::size_t fieldCount = summary_.fields.size();
            block.fields = std::span(mesh_.fields).subspan(first * fieldCount, count * fieldCount);
            sink(block);
        }
    }

    void readTriangles(const TriangleSink& sink) override {
        TriangleBuffer out(sink);
        for (std::uint64_t i = 0; i < mesh_.notAPolygon; ++i)
            out.addPolygon({});
        std::size_t first = 0;
        for (const std::uint32_t size : mesh_.faceSizes) {
            out.addPolygon(std::span(mesh_.corners).subspan(first, size));
            first += size;
        }
        out.flush();
        if (out.count() == 0) throw Error(summary_.path, "no triangles: no face has three corners");
    }

private:
    MemoryMesh mesh_;
    MeshSummary summary_;
};

} // namespace

void requireRoomForWhole(const std::string& path, std::uint64_t fileBytes, Bytes memoryLimit) {
    // Max memory in bytes that one byte of a file needs. It includes arrays, the spare memory of growing arrays, and
    // tables of vertices. Text files with short lines need the most.
    constexpr std::uint64_t kBytesPerFileByte = 12;
    if (fileBytes <= memoryLimit.count / kBytesPerFileByte) return;
    throw Error(
        path,
        "too large: this format is read into memory as a whole; convert the file to PLY, which is streamed",
        "at most " + readableBytes(memoryLimit) + " of memory",
        "a need for up to " + readableBytes({fileBytes * kBytesPerFileByte}));
}

std::unique_ptr<MeshSource> memorySource(const std::string& path, std::uint64_t fileBytes, MemoryMesh mesh) {
    return std::make_unique<MemorySource>(path, fileBytes, std::move(mesh));
}

} // namespace gnomon::read
