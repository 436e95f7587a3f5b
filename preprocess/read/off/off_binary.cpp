#include "preprocess/read/off/off_binary.h"

#include "core/error.h"
#include "preprocess/read/block_buffers.h"
#include "preprocess/read/byte_stream.h"
#include "preprocess/read/off/off_colors.h"

#include <array>
#include <bit>
#include <cstring>
#include <optional>

namespace gnomon::read {

namespace {

/// One of the four ways in which programs write the data of a binary OFF file.
struct Layout {
    std::endian order = std::endian::big;
    bool countsChannels = true; ///< whether a number of colour channels follows the vertex indices of each face
};

constexpr std::array<Layout, 4> kLayouts = {
    {{std::endian::big, true}, {std::endian::little, false}, {std::endian::little, true}, {std::endian::big, false}}};

class OffBytes {
public:
    OffBytes(const InputFile& file, const OffHeader& header, const Layout& layout)
        : stream_(file, header.bodyOffset), header_(header), layout_(layout) {}

    MemoryMesh read(Bytes memoryLimit) {
        const std::uint64_t vertices = number();
        const std::uint64_t faces = number();
        number(); // skips the number of edges, which is not used
        const std::uint64_t floats =
            3U + (header_.hasNormals ? 3 : 0) + (header_.hasColors ? 4 : 0) + (header_.hasTexture ? 2 : 0);
        requireRoom(vertices, sizeof(float) * floats);
        mesh_.positions.reserve(vertices);
        for (std::uint64_t i = 0; i < vertices; ++i)
            readVertex(i);
        requireRoom(faces, sizeof(std::uint32_t));
        for (std::uint64_t i = 0; i < faces; ++i)
            readFace(i);
        if (stream_.remaining() > 0) throw Error(where(), "data after the last face: the counts are too small");
        if (header_.hasTexture && vertices > 0) mesh_.attributesDropped["texture coordinates"] = vertices;
        return withOffColors(std::move(mesh_), colors_, header_.hasColors, stream_.path(), memoryLimit);
    }

private:
    std::string where() const { return atByte(stream_.path(), stream_.offset()); }

    std::uint32_t number() {
        if (!stream_.fill(sizeof(std::uint32_t)))
            throw Error(where(), "the file ends too early", "a number", "the end");
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < sizeof value; ++i) {
            const std::size_t place = layout_.order == std::endian::big ? sizeof value - 1 - i : i;
            value |= std::to_integer<std::uint32_t>(stream_.data()[i]) << (8 * place);
        }
        stream_.consume(sizeof value);
        return value;
    }

    float real() { return std::bit_cast<float>(number()); }

    glm::vec3 vector() {
        const float x = real();
        const float y = real();
        return {x, y, real()};
    }

    void requireRoom(std::uint64_t count, std::uint64_t bytes) const {
        if (count > stream_.remaining() / bytes)
            throw Error(
                where(),
                "the file ends too early",
                std::to_string(count) + " rows of at least " + std::to_string(bytes) + " bytes",
                std::to_string(stream_.remaining()) + " bytes");
    }

    void readVertex(std::uint64_t vertex) {
        mesh_.positions.emplace_back(vector());
        if (header_.hasNormals) {
            const glm::vec3 normal = vector();
            mesh_.normals.push_back(finiteOrZero(normal));
            if (mesh_.normals.back() != normal) ++mesh_.attributesDropped[kBadNormals];
        }
        if (header_.hasColors) {
            const glm::dvec3 color(vector());
            colors_.vertices.add(vertex, std::array{color.r, color.g, color.b, double{real()}});
        }
        if (header_.hasTexture) {
            real();
            real();
        }
    }

    void readFace(std::uint64_t face) {
        const std::uint32_t size = number();
        requireRoom(size, sizeof(std::uint32_t));
        if (size > kMaxPolygonCorners)
            throw Error(
                where(),
                "the face has too many corners",
                "at most " + std::to_string(kMaxPolygonCorners) + " corners",
                std::to_string(size));
        for (std::uint32_t i = 0; i < size; ++i) {
            const std::uint32_t vertex = number();
            if (vertex >= mesh_.positions.size())
                throw Error(
                    where(),
                    "vertex index out of range",
                    "one of " + std::to_string(mesh_.positions.size()) + " vertices",
                    "index " + std::to_string(vertex) + " counted from 0");
            if (!isFinite(mesh_.positions[vertex]))
                throw Error(where(), "a coordinate of vertex " + std::to_string(vertex) + " is not finite");
            mesh_.corners.push_back(vertex);
        }
        mesh_.faceSizes.push_back(size);
        if (!layout_.countsChannels) return;
        readFaceColor(face);
    }

    void readFaceColor(std::uint64_t face) {
        const std::uint32_t count = number();
        requireRoom(count, sizeof(float));
        std::array<double, 4> channels{};
        if (count != 3 && count != 4) {
            if (count > 0) ++mesh_.attributesDropped["other values of faces"];
            return stream_.skip(count * sizeof(float));
        }
        for (std::uint32_t i = 0; i < count; ++i)
            channels[i] = real();
        colors_.faces.add(face, std::span(channels).first(count));
    }

    ByteStream stream_;
    const OffHeader& header_;
    Layout layout_;
    MemoryMesh mesh_;
    OffRowColors colors_;
};

} // namespace

MemoryMesh readOffBinary(const InputFile& file, const OffHeader& header, Bytes memoryLimit) {
    std::optional<Error> first;
    for (const Layout& layout : kLayouts) {
        try {
            return OffBytes(file, header, layout).read(memoryLimit);
        } catch (const Error& error) {
            if (!first) first = error;
        }
    }
    throw Error(*first);
}

} // namespace gnomon::read
