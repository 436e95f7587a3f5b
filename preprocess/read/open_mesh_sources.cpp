#include "preprocess/read/open_mesh_sources.h"

#include "core/check.h"
#include "core/error.h"
#include "core/file.h"
#include "preprocess/read/gltf/gltf_source.h"
#include "preprocess/read/input_file.h"
#include "preprocess/read/obj/obj_source.h"
#include "preprocess/read/off/off_source.h"
#include "preprocess/read/ply/ply_source.h"
#include "preprocess/read/stl/stl_source.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>

namespace gnomon::read {

namespace {

std::optional<double> maxOf(const std::optional<double>& a, const std::optional<double>& b) {
    return a && b ? std::max(*a, *b) : a ? a : b;
}

class JoinedSource final : public MeshSource {
public:
    explicit JoinedSource(std::vector<std::unique_ptr<MeshSource>> parts) : parts_(std::move(parts)) {
        summary_.hasNormals = true;
        summary_.hasRanges = true;
        summary_.fields = parts_.front()->summary().fields;
        std::vector<Camera> cameras;
        for (const auto& part : parts_) {
            const MeshSummary& more = part->summary();
            summary_.path += (summary_.path.empty() ? "" : ", ") + more.path;
            summary_.fileBytes += more.fileBytes;
            summary_.vertexCount += more.vertexCount;
            summary_.faceCount += more.faceCount;
            summary_.stripCount += more.stripCount;
            summary_.likelyTriangles += more.likelyTriangles;
            summary_.hasNormals &= more.hasNormals;
            summary_.hasRanges &= more.hasRanges;
            summary_.hasColors |= more.hasColors;
            summary_.isDouble |= more.isDouble;
            summary_.heldBytes += more.heldBytes;
            summary_.texelsPerEdge = maxOf(summary_.texelsPerEdge, more.texelsPerEdge);
            summary_.additionalFiles.insert(
                summary_.additionalFiles.end(), more.additionalFiles.begin(), more.additionalFiles.end());
            summary_.remarks.insert(summary_.remarks.end(), more.remarks.begin(), more.remarks.end());
            for (const auto& [name, count] : more.attributesDropped)
                summary_.attributesDropped[name] += count;
            cameras.insert(cameras.end(), more.cameras.begin(), more.cameras.end());
        }
        takeCameras(cameras, summary_);
    }

    const MeshSummary& summary() const override { return summary_; }

    void readVertices(const VertexSink& sink) override {
        std::uint64_t first = 0;
        for (const auto& part : parts_) {
            part->readVertices([&](const VertexBlock& block) { sink(joined(block, first)); });
            first += part->summary().vertexCount;
        }
    }

    void readTriangles(const TriangleSink& sink) override {
        std::uint64_t firstVertex = 0;
        std::uint64_t firstTriangle = 0;
        std::vector<TriangleCorners> shifted;
        for (const auto& part : parts_) {
            std::uint64_t end = firstTriangle;
            part->readTriangles([&](TriangleBlock block) {
                block = joined(block, firstVertex, firstTriangle, shifted);
                end = block.firstTriangle + shifted.size();
                sink(block);
            });
            firstTriangle = end;
            firstVertex += part->summary().vertexCount;
        }
    }

    void readVertexRange(std::uint64_t begin, std::uint64_t end, const VertexSink& sink) override {
        std::uint64_t first = 0;
        for (const auto& part : parts_) {
            const std::uint64_t count = part->summary().vertexCount;
            const std::uint64_t partBegin = std::clamp(begin, first, first + count) - first;
            const std::uint64_t partEnd = std::clamp(end, first, first + count) - first;
            if (partBegin < partEnd)
                part->readVertexRange(
                    partBegin, partEnd, [&](const VertexBlock& block) { sink(joined(block, first)); });
            first += count;
        }
    }

    std::optional<RowIndex> indexRows(Progress& progress) override {
        RowIndex index;
        for (const auto& part : parts_) {
            std::optional<RowIndex> more = part->indexRows(progress);
            if (!more) return std::nullopt;
            index.parts.push_back(std::move(more->parts.at(0)));
        }
        return index;
    }

    void takeRowIndex(const RowIndex& index) override {
        if (index.parts.size() != parts_.size())
            throw Error(
                summary_.path,
                "another process reads other input files; start all processes with the same command line");
        for (std::size_t i = 0; i < parts_.size(); ++i)
            parts_[i]->takeRowIndex({{index.parts[i]}});
    }

    std::uint64_t triangleCount() const override {
        std::uint64_t count = 0;
        for (const auto& part : parts_)
            count += part->triangleCount();
        return count;
    }

    bool readFaceRange(std::uint64_t begin, std::uint64_t end, const TriangleSink& sink) override {
        std::uint64_t firstVertex = 0;
        std::uint64_t firstTriangle = 0;
        std::uint64_t first = 0;
        std::vector<TriangleCorners> shifted;
        for (const auto& part : parts_) {
            const std::uint64_t count = part->summary().faceCount;
            const std::uint64_t partBegin = std::clamp(begin, first, first + count) - first;
            const std::uint64_t partEnd = std::clamp(end, first, first + count) - first;
            const auto take = [&](const TriangleBlock& block) {
                sink(joined(block, firstVertex, firstTriangle, shifted));
            };
            if (partBegin < partEnd && !part->readFaceRange(partBegin, partEnd, take)) return false;
            first += count;
            firstTriangle += part->triangleCount();
            firstVertex += part->summary().vertexCount;
        }
        return true;
    }

    void pollWith(Progress& progress) override {
        for (const auto& part : parts_)
            part->pollWith(progress);
    }

    void requireUnchanged() const override {
        for (const auto& part : parts_)
            part->requireUnchanged();
    }

    std::string whereIs(std::uint64_t vertex) override {
        auto part = parts_.begin();
        for (; vertex >= (*part)->summary().vertexCount; ++part)
            vertex -= (*part)->summary().vertexCount;
        return (*part)->whereIs(vertex);
    }

private:
    VertexBlock joined(VertexBlock block, std::uint64_t firstVertex) const {
        block.firstVertex += firstVertex;
        if (!summary_.hasNormals) block.normals = {};
        return block;
    }

    /// Returns `block` with its vertex and triangle indices shifted to the joined mesh. `shifted` owns the memory of
    /// the returned triangles.
    static TriangleBlock joined(
        TriangleBlock block,
        std::uint64_t firstVertex,
        std::uint64_t firstTriangle,
        std::vector<TriangleCorners>& shifted) {
        shifted.assign(block.triangles.begin(), block.triangles.end());
        for (TriangleCorners& triangle : shifted)
            for (std::uint64_t& corner : triangle)
                corner += firstVertex;
        block.firstTriangle += firstTriangle;
        block.triangles = shifted;
        return block;
    }

    std::vector<std::unique_ptr<MeshSource>> parts_;
    MeshSummary summary_;
};

bool startsWith(const std::string& path, std::string_view magic) {
    const File file(path, File::Mode::Read);
    std::array<std::byte, 8> begin{};
    const std::size_t count = file.readSomeAt(0, begin);
    return count >= magic.size() && std::memcmp(begin.data(), magic.data(), magic.size()) == 0;
}

/// A file format that Gnomon cannot read, with advice to the user for the error message.
struct OtherFormat {
    std::string_view suffix;
    const char* advice;
};

constexpr std::array kOtherFormats = {
    OtherFormat{".las", "LAS is points, not triangles: make a mesh of it first (CloudCompare, PDAL)"},
    OtherFormat{".laz", "LAZ is points, not triangles: make a mesh of it first (CloudCompare, PDAL)"},
    OtherFormat{".e57", "E57 is points, not triangles: make a mesh of it first (CloudCompare)"},
    OtherFormat{".fbx", "FBX is not read: convert it to glTF (Blender)"},
    OtherFormat{".3mf", "3MF is not read: convert it to STL or OBJ (PrusaSlicer, Blender)"},
    OtherFormat{".usd", "USD is not read: convert it to glTF (Blender)"},
    OtherFormat{".usda", "USD is not read: convert it to glTF (Blender)"},
    OtherFormat{".usdc", "USD is not read: convert it to glTF (Blender)"},
    OtherFormat{".usdz", "USD is not read: convert it to glTF (Blender)"},
    OtherFormat{".dae", "COLLADA is not read: convert it to glTF (Blender)"},
    OtherFormat{".ifc", "IFC is not read: convert it to glTF (IfcConvert)"},
    OtherFormat{".blend", "a scene of Blender is not read: export it as glTF"},
};

[[noreturn]] void refuse(const std::string& path, const std::string& suffix) {
    if (startsWith(path, "\x89GNM"))
        throw Error(path, "this file is already a model (.gnm): use it with gnomon render, view or info");
    for (const OtherFormat& format : kOtherFormats)
        if (format.suffix == suffix) throw Error(path, format.advice);
    throw Error(
        path,
        "unknown mesh format",
        "PLY, OBJ, STL, OFF or glTF",
        suffix.empty() ? "a name without suffix" : "the suffix " + quotedForMessage(suffix));
}

/// Opens `path` with the reader for its format, detected from the file's first bytes or otherwise from the suffix.
std::unique_ptr<MeshSource> openByFormat(
    const std::string& path,
    Bytes room,
    const std::vector<std::string>& fields,
    Textures textures,
    const std::string& sourceRoot) {
    const bool isPly = startsWith(path, "ply");
    if (File(path, File::Mode::Read).size() == 0) throw Error(path, "the file is empty");
    const std::string suffix = loweredSuffix(path);
    if (isPly || suffix == ".ply") return openPlyWithFaceColors(path, room, fields);
    const bool isGltf = suffix == ".gltf" || suffix == ".glb" || startsWith(path, "glTF");
    const bool isOther = suffix == ".obj" || suffix == ".off" || suffix == ".stl";
    if (!isGltf && !isOther) refuse(path, suffix);
    if (!fields.empty()) throw Error(path, "only a PLY can have fields", "none", fields.front());
    if (isGltf) return readGltf(path, room, textures == Textures::Bake, sourceRoot);
    if (suffix == ".obj") return openObj(path, room, sourceRoot);
    return suffix == ".off" ? readOff(path, room) : readStl(path, room);
}

} // namespace

std::unique_ptr<MeshSource> openMeshSources(
    const std::vector<std::string>& paths,
    Bytes memoryLimit,
    const std::vector<std::string>& fields,
    Textures textures,
    const std::string& sourceRoot) {
    GNOMON_CHECK(!paths.empty());
    std::vector<std::unique_ptr<MeshSource>> parts;
    parts.reserve(paths.size());
    Bytes room = memoryLimit;
    for (const std::string& path : paths) {
        requireRereadable(path);
        parts.push_back(openByFormat(path, room, fields, textures, sourceRoot));
        room.count -= std::min(room.count, parts.back()->summary().heldBytes);
    }
    if (parts.size() == 1) return std::move(parts.front());
    return std::make_unique<JoinedSource>(std::move(parts));
}

} // namespace gnomon::read
