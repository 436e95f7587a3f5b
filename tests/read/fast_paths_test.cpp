// The fast paths for binary PLY bodies beside the rows that are read value by value.
#include "core/random.h"
#include "preprocess/read/ply/ply_fast.h"
#include "tests/read/scratch_input.h"

#include <gtest/gtest.h>

namespace gnomon::read {
namespace {

std::string randomBytes(Random& random, std::uint64_t count) {
    std::string bytes;
    for (std::uint64_t i = 0; i < count; ++i)
        bytes += static_cast<char>(random.below(256));
    return bytes;
}

class PlyFast : public ScratchInput {};

/// An element of vertices in any order and of any types, among values that nobody wants.
struct AnyVertices {
    explicit AnyVertices(Random& random) {
        layout.property.fill(-1);
        layout.hasNormals = random.below(2) == 0;
        layout.hasColors = random.below(2) == 0;
        for (std::size_t slot = 0; slot < kVertexSlots; ++slot) {
            if (random.below(4) == 0) addProperty(random);
            const bool isWanted = slot < kNormal || (slot < kColor ? layout.hasNormals : layout.hasColors);
            if (isWanted) layout.property[slot] = addProperty(random);
        }
        element.count = random.below(random.below(3) == 0 ? 40'000 : 500);
    }

    int addProperty(Random& random) {
        element.properties.push_back({"any", kTypes[random.below(kTypes.size())], false, {}});
        return static_cast<int>(element.properties.size()) - 1;
    }

    PlyElement element{"vertex", 0, {}};
    VertexLayout layout;
};

/// What `readRows` reads of `vertices` from `file`, as bits, since a NaN equals nothing.
template <class ReadRows>
std::vector<std::uint64_t> bitsOf(
    const InputFile& file, PlyFormat format, const AnyVertices& vertices, const ReadRows& readRows) {
    std::vector<std::uint64_t> bits;
    const VertexSink sink = [&](const VertexBlock& block) {
        for (const glm::dvec3& p : block.positions)
            for (int axis = 0; axis < 3; ++axis)
                bits.push_back(std::isnan(p[axis]) ? 1 : std::bit_cast<std::uint64_t>(p[axis]));
        for (const glm::vec3& n : block.normals)
            for (int axis = 0; axis < 3; ++axis)
                bits.push_back(std::bit_cast<std::uint32_t>(n[axis]));
        bits.insert(bits.end(), block.colors.begin(), block.colors.end());
    };
    VertexBuffer out(sink, {vertices.layout.hasNormals, vertices.layout.hasColors});
    BinaryValues values(file, format, {0, 0});
    values.beginElement(vertices.element);
    readRows(values, out);
    out.flush();
    values.expectEnd();
    return bits;
}

TEST_F(PlyFast, ColumnsAreRowsForAnyBytes) {
    Random random(1);
    for (int trial = 0; trial < 60; ++trial) {
        const AnyVertices any(random);
        const PlyFormat format = random.below(2) == 0 ? PlyFormat::BinaryLittleEndian : PlyFormat::BinaryBigEndian;
        const InputFile& file = fileOf(randomBytes(random, any.element.count * any.element.minRowBytes(format)));
        const auto fast = bitsOf(file, format, any, [&](BinaryValues& values, VertexBuffer& out) {
            readVertexColumns(values, any.element, any.layout, out);
        });
        const auto slow = bitsOf(file, format, any, [&](BinaryValues& values, VertexBuffer& out) {
            readVertexRows(values, any.element, any.layout, out);
        });
        ASSERT_GE(fast.size(), 3 * any.element.count);
        ASSERT_TRUE(fast == slow) << trial;
    }
}

/// A body of faces: mostly triangles, some polygons, and now and then an index out of range.
std::string faceBytes(Random& random, std::uint64_t count, bool isBig, bool isSound) {
    std::string bytes;
    for (std::uint64_t face = 0; face < count; ++face) {
        const std::uint64_t corners = random.below(10) == 0 ? random.below(7) : 3;
        bytes += static_cast<char>(corners);
        for (std::uint64_t i = 0; i < corners; ++i) {
            std::uint64_t index = random.below(1000);
            if (!isSound && random.below(2000) == 0) index = 1000 + random.below(4'000'000'000U);
            for (unsigned byte = 0; byte < 4; ++byte)
                bytes += static_cast<char>(index >> (isBig ? 24 - 8 * byte : 8 * byte));
        }
    }
    return bytes;
}

constexpr std::uint64_t kVertices = 1000;

/// What `readRows` makes of `element` in `file`: its triangles, polygons and faces that are none, or what it refuses.
template <class ReadRows>
std::string toldOf(const InputFile& file, PlyFormat format, const PlyElement& element, const ReadRows& readRows) {
    std::string told;
    const TriangleSink sink = [&](const TriangleBlock& block) {
        for (const auto& [a, b, c] : block.triangles)
            told += std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
        for (const PolygonRun& run : block.polygons)
            told += "polygon of " + std::to_string(run.count) + "\n";
        told += block.notAPolygon > 0 ? std::to_string(block.notAPolygon) + " are none\n" : "";
    };
    try {
        TriangleBuffer out(sink);
        BinaryValues values(file, format, {0, 0});
        values.beginElement(element);
        readRows(values, out);
        out.flush();
        values.expectEnd();
    } catch (const Error& error) {
        return error.what();
    }
    return told;
}

TEST_F(PlyFast, FacesInPlaceAreFacesRowByRow) {
    Random random(2);
    int refused = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const PlyType type = trial % 2 == 0 ? PlyType::Int32 : PlyType::Uint32;
        const PlyElement element{
            "face", 1 + random.below(trial % 10 == 0 ? 40'000 : 500), {{"vertex_indices", type, true, PlyType::Uint8}}};
        const bool isBig = random.below(2) == 0;
        const PlyFormat format = isBig ? PlyFormat::BinaryBigEndian : PlyFormat::BinaryLittleEndian;
        const InputFile& file = fileOf(faceBytes(random, element.count, isBig, trial % 4 != 0));
        const std::string fast = toldOf(file, format, element, [&](BinaryValues& values, TriangleBuffer& out) {
            readFaceRows(values, element, 0, kVertices, out);
        });
        std::vector<std::uint64_t> corners;
        const std::string slow = toldOf(file, format, element, [&](BinaryValues& values, TriangleBuffer& out) {
            for (std::uint64_t row = 0; row < element.count; ++row)
                readFaceRow(values, element, 0, kVertices, out, corners);
        });
        ASSERT_EQ(fast, slow) << trial;
        refused += slow.find("out of range") != std::string::npos ? 1 : 0;
    }
    EXPECT_GT(refused, 3);
}

} // namespace
} // namespace gnomon::read
