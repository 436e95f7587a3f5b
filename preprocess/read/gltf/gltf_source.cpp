#include "preprocess/read/gltf/gltf_source.h"

#include "core/error.h"
#include "preprocess/read/block_buffers.h"
#include "preprocess/read/gltf/gltf_file.h"
#include "preprocess/read/gltf/gltf_nodes.h"
#include "preprocess/read/gltf/gltf_primitive.h"

#include <algorithm>
#include <cmath>

namespace gnomon::read {

namespace {

constexpr std::uint32_t kWhite = 0xFFFFFFFF;

/// A primitive of a glTF mesh, placed in world space by a transform.
struct PlacedPrimitive {
    std::uint32_t primitive = 0;
    glm::dmat4 toWorld{1};

    bool isMirrored() const { return glm::determinant(scaled()) < 0; }

    /// Returns the matrix that transforms normals: the inverse transpose of the linear part of `toWorld`, up to a
    /// factor. The matrix consists of cofactors, so there is no division by zero.
    glm::dmat3 ofNormals() const {
        const glm::dmat3 m = scaled();
        const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
        return isMirrored() ? -cofactors : cofactors;
    }

private:
    /// Returns the linear part of `toWorld`, scaled by a power of two so that its largest entry is in [1, 2).
    glm::dmat3 scaled() const {
        const glm::dmat3 m(toWorld);
        double largest = 0;
        for (int i = 0; i < 9; ++i)
            largest = std::max(largest, std::abs(m[i / 3][i % 3]));
        return m * scaleToOne(largest);
    }
};

glm::vec3 unitOrNone(const glm::dvec3& normal) {
    const double length = glm::length(normal);
    return length > 0 && length < 1e300 ? glm::vec3(normal / length) : glm::vec3(0);
}

class GltfSource final : public MeshSource {
public:
    GltfSource(const std::string& path, Bytes limit, bool bakesTextures, const std::string& sourceRoot) {
        GltfFile file(path, limit, bakesTextures, sourceRoot);
        GltfPrimitives reader(file, bakesTextures);
        const GltfScene scene = sceneOf(file);
        takePlacements(file, reader, scene);
        summarize(file, reader, scene);
        files_ = std::move(file).takeFiles();
        for (std::size_t i = 1; i < files_.size(); ++i)
            summary_.additionalFiles.push_back(files_[i]->path());
    }

    const MeshSummary& summary() const override { return summary_; }

    void readVertices(const VertexSink& sink) override {
        VertexBuffer out(sink, {summary_.hasNormals, summary_.hasColors, 0});
        for (const PlacedPrimitive& placed : placed_) {
            const GltfPrimitive& from = primitives_[placed.primitive];
            const glm::dmat3 ofNormals = placed.ofNormals();
            for (std::uint64_t first = 0; first < from.vertexCount();) {
                const auto count =
                    static_cast<std::size_t>(std::min<std::uint64_t>(out.room(), from.vertexCount() - first));
                const VertexBuffer::Rows rows = out.append(count);
                for (std::size_t i = 0; i < count; ++i)
                    fill(rows, i, from, first + i, placed.toWorld, ofNormals);
                out.flushIfFull();
                first += count;
            }
            poll();
        }
        out.flush();
    }

    void readTriangles(const TriangleSink& sink) override {
        TriangleBuffer out(sink);
        std::uint64_t first = 0;
        for (const PlacedPrimitive& placed : placed_) {
            const GltfPrimitive& from = primitives_[placed.primitive];
            const bool isMirrored = placed.isMirrored();
            for (const auto& [a, b, c] : from.triangles)
                out.add({first + a, first + (isMirrored ? c : b), first + (isMirrored ? b : c)});
            first += from.vertexCount();
            poll();
        }
        out.flush();
    }

    void pollWith(Progress& progress) override { progress_ = &progress; }

    void requireUnchanged() const override {
        for (const auto& file : files_)
            file->requireUnchanged();
    }

private:
    void poll() {
        if (progress_ != nullptr) progress_->advance(0);
    }

    /// Reads each mesh that the scene uses once, and stores the transforms of all its instances.
    void takePlacements(GltfFile& file, GltfPrimitives& reader, const GltfScene& scene) {
        struct Range {
            std::uint32_t begin = 0;
            std::uint32_t end = 0;
        };

        std::map<int, Range> ranges;
        for (const PlacedMesh& placed : scene.meshes) {
            auto found = ranges.find(placed.mesh);
            if (found == ranges.end()) {
                const auto begin = static_cast<std::uint32_t>(primitives_.size());
                for (const tinygltf::Primitive& from :
                     file.model().meshes[static_cast<std::size_t>(placed.mesh)].primitives)
                    if (std::optional<GltfPrimitive> primitive = reader.read(from))
                        primitives_.push_back(std::move(*primitive));
                found = ranges.emplace(placed.mesh, Range{begin, static_cast<std::uint32_t>(primitives_.size())}).first;
            }
            file.room().take(found->second.end - found->second.begin, sizeof(PlacedPrimitive));
            for (std::uint32_t i = found->second.begin; i < found->second.end; ++i)
                placed_.push_back({i, placed.toWorld});
        }
    }

    void summarize(const GltfFile& file, const GltfPrimitives& reader, const GltfScene& scene) {
        summary_.path = file.path();
        summary_.fileBytes = file.fileBytes();
        std::uint64_t withNormals = 0;
        for (const GltfPrimitive& primitive : primitives_) {
            withNormals += primitive.normals.empty() ? 0 : 1;
            summary_.hasColors |= !primitive.colors.empty();
            summary_.heldBytes += (primitive.positions.capacity() + primitive.normals.capacity()) * sizeof(float) +
                                  primitive.colors.capacity() * sizeof(std::uint32_t) +
                                  primitive.triangles.capacity() * sizeof(primitive.triangles[0]);
        }
        summary_.hasNormals = withNormals == primitives_.size();
        for (const PlacedPrimitive& placed : placed_) {
            summary_.vertexCount += primitives_[placed.primitive].vertexCount();
            summary_.faceCount += primitives_[placed.primitive].triangles.size();
            summary_.isDouble |= placed.toWorld != glm::dmat4(1);
        }
        summary_.heldBytes += placed_.capacity() * sizeof(PlacedPrimitive);
        summary_.likelyTriangles = summary_.faceCount;
        for (const auto& counts : {file.rejected(), scene.rejected, reader.rejected()})
            for (const auto& [name, count] : counts)
                summary_.attributesDropped[name] += count;
        if (!summary_.hasNormals && withNormals > 0) summary_.attributesDropped["NORMAL"] += withNormals;
        takeCameras(scene.cameras, summary_);
        if (reader.texelsPerEdge() > 0) summary_.texelsPerEdge = reader.texelsPerEdge();
        if (summary_.faceCount == 0) throw Error(file.path(), "no triangles: no mesh of the scene has triangles");
    }

    void fill(
        const VertexBuffer::Rows& rows,
        std::size_t row,
        const GltfPrimitive& from,
        std::uint64_t vertex,
        const glm::dmat4& toWorld,
        const glm::dmat3& ofNormals) const {
        const auto three = [&](const std::vector<float>& values) {
            return glm::dvec3(values[3 * vertex], values[3 * vertex + 1], values[3 * vertex + 2]);
        };
        rows.positions[row] = glm::dvec3(toWorld * glm::dvec4(three(from.positions), 1));
        if (summary_.hasNormals) rows.normals[row] = unitOrNone(ofNormals * three(from.normals));
        if (summary_.hasColors) rows.colors[row] = from.colors.empty() ? kWhite : from.colors[vertex];
    }

    std::vector<std::unique_ptr<InputFile>> files_;
    std::vector<GltfPrimitive> primitives_;
    std::vector<PlacedPrimitive> placed_;
    MeshSummary summary_;
    Progress* progress_ = nullptr;
};

} // namespace

std::unique_ptr<MeshSource> readGltf(
    const std::string& path, Bytes memoryLimit, bool bakesTextures, const std::string& sourceRoot) {
    return std::make_unique<GltfSource>(path, memoryLimit, bakesTextures, sourceRoot);
}

} // namespace gnomon::read
