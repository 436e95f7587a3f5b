#include "preprocess/read/off/off_binary.h"

#include "core/error.h"
#include "preprocess/read/block_buffers.h"
#include "preprocess/read/byte_stream.h"
#include "preprocess/read/color_range.h"

#include <array>
#include <bit>
#include <cstring>
#include <optional>

namespace gnomon::read {

namespace {

/// How a program writes the body.
struct Layout {
    std::endian order = std::endian::big;
    bool countsChannels = true; ///< behind the corners of each face
};

constexpr std::array<Layout, 4> kLayouts = {
    {{std::endian::big, true}, {std::endian::little, false}, {std::endian::little, true}, {std::endian::big, false}}};

class OffBytes {
public:
    OffBytes(const InputFile& file, const OffHeader& header, const Layout& layout)
        : stream_(file, header.bodyOffset), header_(header), layout_(layout) {}

    MemoryMesh read() {
        const std::uint64_t vertices = number();
        const std::uint64_t faces = number();
        number(); // of edges
        const std::uint64_t floats =
            3U + (header_.hasNormals ? 3 : 0) + (header_.hasColors ? 4 : 0) + (header_.hasTexture ? 2 : 0);
        requireRoom(vertices, sizeof(float) * floats);
        mesh_.positions.reserve(vertices);
        for (std::uint64_t i = 0; i < vertices; ++i)
            readVertex();
        requireRoom(faces, sizeof(std::uint32_t));
        for (std::uint64_t i = 0; i < faces; ++i)
            readFace();
        if (stream_.remaining() > 0) throw Error(where(), "data after the last face: the counts are too small");
        if (header_.hasTexture && vertices > 0) mesh_.attributesDropped["texture coordinates"] = vertices;
        return std::move(mesh_);
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

    void readVertex() {
        mesh_.positions.emplace_back(vector());
        if (header_.hasNormals) {
            const glm::vec3 normal = vector();
            mesh_.normals.push_back(finiteOrZero(normal));
            if (mesh_.normals.back() != normal) ++mesh_.attributesDropped["normals that are not finite"];
        }
        if (header_.hasColors) {
            const glm::vec3 color = vector();
            mesh_.colors.push_back(packedChannels({color, real()}, 1));
        }
        if (header_.hasTexture) {
            real();
            real();
        }
    }

    void readFace() {
        const std::uint32_t size = number();
        requireRoom(size, sizeof(std::uint32_t));
        if (size > kMostPolygonCorners)
            throw Error(
                where(),
                "too large a face",
                "at most " + std::to_string(kMostPolygonCorners) + " corners",
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
        const std::uint32_t channels = number();
        if (channels > 0) ++mesh_.attributesDropped["face colours"];
        requireRoom(channels, sizeof(float));
        stream_.skip(channels * sizeof(float));
    }

    ByteStream stream_;
    const OffHeader& header_;
    Layout layout_;
    MemoryMesh mesh_;
};

} // namespace

MemoryMesh readOffBinary(const InputFile& file, const OffHeader& header) {
    std::optional<Error> first;
    for (const Layout& layout : kLayouts) {
        try {
            return OffBytes(file, header, layout).read();
        } catch (const Error& error) {
            if (!first) first = error;
        }
    }
    throw Error(*first);
}

} // namespace gnomon::read
