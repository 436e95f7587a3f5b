// The parts of the PLY reader: headers, values of every type from bytes and from text, and colour channels.
#include "core/error.h"
#include "core/random.h"
#include "preprocess/read/ply/ply_header.h"
#include "preprocess/read/ply/ply_rows.h"
#include "preprocess/read/ply/ply_values.h"
#include "tests/read/scratch_input.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace gnomon::read {
namespace {

class PlyParts : public ScratchInput {};

TEST_F(PlyParts, AHeaderKnowsElementsPropertiesAndWhereTheBodyBegins) {
    const std::string header = "ply\r\nformat binary_big_endian 1.0\r\ncomment element x 3\r\nobj_info y\r\n"
                               "element vertex 2\r\nproperty float x\r\nproperty uchar red\r\n"
                               "element face 1\r\nproperty list uint8 int32 vertex_index\r\nproperty short flags\r\n"
                               "element edge 0\r\nend_header\r\n";
    const PlyHeader found = readPlyHeader(fileOf(header + std::string(64, '\0')));
    EXPECT_EQ(found.format, PlyFormat::BinaryBigEndian);
    EXPECT_EQ(found.bodyOffset, header.size());
    EXPECT_EQ(found.bodyLine, 13U);
    EXPECT_EQ(found.lineEnd, '\n');
    ASSERT_EQ(found.elements.size(), 3U);
    const PlyElement& vertex = found.elements[0];
    EXPECT_EQ(vertex.name, "vertex");
    EXPECT_EQ(vertex.count, 2U);
    EXPECT_EQ(vertex.indexOf("red"), 1);
    EXPECT_EQ(vertex.indexOf("green"), -1);
    EXPECT_EQ(vertex.indexOf("diffuse_red", "red"), 1) << "by its other name";
    EXPECT_FALSE(vertex.hasLists());
    EXPECT_EQ(vertex.minRowBytes(PlyFormat::BinaryBigEndian), 5U);
    EXPECT_EQ(vertex.minRowBytes(PlyFormat::Ascii), 4U);
    const PlyElement& face = found.elements[1];
    EXPECT_TRUE(face.hasLists());
    EXPECT_TRUE(face.properties[0].isList);
    EXPECT_EQ(face.properties[0].countType, PlyType::Uint8);
    EXPECT_EQ(face.properties[0].type, PlyType::Int32);
    EXPECT_FALSE(face.properties[1].isList);
    EXPECT_EQ(face.minRowBytes(PlyFormat::BinaryLittleEndian), 3U) << "an empty list and a short";
    EXPECT_EQ(found.elements[2].minRowBytes(PlyFormat::Ascii), 0U);
}

TEST_F(PlyParts, AHeaderOfTheOldMacEndsItsLinesInCarriageReturns) {
    const PlyHeader found =
        readPlyHeader(fileOf("ply\rformat ascii 1.0\relement vertex 1\rproperty int x\rend_header\r7\r"));
    EXPECT_EQ(found.lineEnd, '\r');
    EXPECT_EQ(found.elements[0].count, 1U);
    EXPECT_EQ(found.bodyLine, 6U);
}

TEST_F(PlyParts, CountsAreHeldAgainstTheBytesThatAreThere) {
    const auto header = [](std::uint64_t count) {
        return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
               "\nproperty double x\nend_header\n";
    };
    EXPECT_EQ(readPlyHeader(fileOf(header(3) + std::string(24, 'x'))).elements[0].count, 3U);
    EXPECT_THROW(readPlyHeader(fileOf(header(3) + std::string(23, 'x'))), Error);
    EXPECT_THROW(readPlyHeader(fileOf(header(std::uint64_t{1} << 61U) + std::string(24, 'x'))), Error)
        << "eight times as many bytes is none in 64 bits";
}

TEST(PlyTypes, HaveTheirSizes) {
    std::uint32_t total = 0;
    for (const PlyType type : kTypes)
        total += byteSize(type);
    EXPECT_EQ(total, 1U + 1 + 2 + 2 + 4 + 4 + 4 + 8);
    EXPECT_TRUE(isFloat(PlyType::Float32) && isFloat(PlyType::Float64));
    EXPECT_FALSE(isFloat(PlyType::Int32));
}

/// The integer of `size` bytes, put together byte by byte.
std::int64_t plainInteger(PlyType type, std::span<const std::byte> bytes, bool isBig) {
    const std::uint32_t size = byteSize(type);
    std::uint64_t value = 0;
    for (std::uint32_t b = 0; b < size; ++b)
        value |= static_cast<std::uint64_t>(bytes[b]) << 8 * (isBig ? size - 1 - b : b);
    const bool isSigned = type == PlyType::Int8 || type == PlyType::Int16 || type == PlyType::Int32;
    const std::uint64_t sign = std::uint64_t{1} << (8 * size - 1);
    const std::uint64_t above = isSigned && (value & sign) != 0 ? 2 * sign : 0;
    return static_cast<std::int64_t>(value) - static_cast<std::int64_t>(above);
}

TEST(PlyTypes, AValueIsReadInItsOwnTypeFromEitherEnd) {
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        std::array<std::byte, 8> bytes{};
        for (std::byte& byte : bytes)
            byte = static_cast<std::byte>(random.bits());
        const auto whole = [](auto value) { return static_cast<std::int64_t>(value); };
        for (const PlyType type : kTypes)
            for (const bool isBig : {false, true})
                if (!isFloat(type)) {
                    ASSERT_EQ(withValue(type, bytes.data(), isBig, whole), plainInteger(type, bytes, isBig));
                }
        std::array<std::byte, 8> reversed = bytes;
        std::reverse(reversed.begin(), reversed.end());
        const auto asDouble = loadValue<double>(bytes.data(), false);
        const auto swapped = loadValue<double>(reversed.data(), true);
        EXPECT_EQ(std::bit_cast<std::uint64_t>(asDouble), std::bit_cast<std::uint64_t>(swapped));
    }
}

TEST_F(PlyParts, BinaryValuesKnowTheirPlaceAndWhatIsLeft) {
    std::string body("\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0A", 10);
    BinaryValues values(fileOf("skip" + body), PlyFormat::BinaryLittleEndian, {4, 0});
    values.beginElement({"vertex", 3, {}});
    EXPECT_EQ(values.maxValues(PlyType::Int16), 5U);
    EXPECT_EQ(values.integer(PlyType::Uint16), 0x0201);
    EXPECT_EQ(values.where(), path + ": byte 4");
    values.skip(PlyType::Uint8, 2);
    EXPECT_EQ(values.integer(PlyType::Int8), 5);
    EXPECT_EQ(values.place().offset, 9U);
    values.endRow();
    EXPECT_EQ(values.row(), "row 2 of 3 of element \"vertex\"");
    EXPECT_FALSE(values.isSwapped());
    try {
        values.skipRows(3, 2);
        ADD_FAILURE() << "six bytes of five";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("expected 3 rows of element \"vertex\""), std::string::npos)
            << error.what();
    }
    BinaryValues big(fileOf("\x01\x02"), PlyFormat::BinaryBigEndian, {0, 0});
    EXPECT_EQ(big.integer(PlyType::Uint16), 0x0102);
    EXPECT_TRUE(big.isSwapped());
    big.expectEnd();
}

TEST_F(PlyParts, AFractionIsNoIndex) {
    const float half = 0.5F;
    const float two = 2;
    std::string body(8, '\0');
    std::memcpy(body.data(), &two, 4);
    std::memcpy(body.data() + 4, &half, 4);
    BinaryValues values(fileOf(body), PlyFormat::BinaryLittleEndian, {0, 0});
    EXPECT_EQ(values.integer(PlyType::Float32), 2);
    EXPECT_THROW(values.integer(PlyType::Float32), Error);
}

TEST_F(PlyParts, AsciiValuesAreRoundedToTheirType) {
    AsciiValues values(fileOf("1 0.1 0.1\n 2\n+3 nan\n"), '\n', {0, 1});
    values.beginElement({"vertex", 3, {}});
    EXPECT_EQ(values.integer(PlyType::Int32), 1);
    EXPECT_EQ(values.real(PlyType::Float32), static_cast<double>(0.1F));
    EXPECT_EQ(values.real(PlyType::Float64), 0.1);
    values.endRow();
    EXPECT_EQ(values.integer(PlyType::Uint8), 2);
    EXPECT_EQ(values.place().line, 2U);
    values.endRow();
    EXPECT_EQ(values.real(PlyType::Float32), 3);
    EXPECT_TRUE(std::isnan(values.real(PlyType::Float32)));
    values.endRow();
    values.expectEnd();
}

TEST(PlyRows, ColorsAreBytesWhateverTheirType) {
    EXPECT_EQ(colorByte(PlyType::Uint8, 200, 255), 200);
    EXPECT_EQ(colorByte(PlyType::Int8, -1, 255), 255);
    EXPECT_EQ(colorByte(PlyType::Int32, 300, 255), 255);
    EXPECT_EQ(colorByte(PlyType::Int32, -5, 255), 0);
    EXPECT_EQ(colorByte(PlyType::Float32, 0.5, 1), 128);
    EXPECT_EQ(colorByte(PlyType::Float64, 1, 1), 255);
    EXPECT_EQ(colorByte(PlyType::Float64, 7, 1), 255);
    EXPECT_EQ(colorByte(PlyType::Float64, 7, 255), 7);
    EXPECT_EQ(colorByte(PlyType::Float32, std::numeric_limits<double>::quiet_NaN(), 1), 0);
    EXPECT_EQ(colorByte(PlyType::Uint16, 65535, 65535), 255);
    EXPECT_EQ(colorByte(PlyType::Uint16, 32896, 65535), 128);
    EXPECT_EQ(finiteOrZero({1, 2, std::numeric_limits<float>::infinity()}), glm::vec3(0));
    EXPECT_EQ(finiteOrZero({1, 2, 3}), glm::vec3(1, 2, 3));
}

TEST(PlyRows, ALayoutHasWhatItHasAllOf) {
    VertexLayout layout;
    layout.property.fill(-1);
    EXPECT_FALSE(layout.has(kPosition, 3));
    layout.property[0] = layout.property[1] = layout.property[2] = 4;
    EXPECT_TRUE(layout.has(kPosition, 3));
    EXPECT_FALSE(layout.has(kPosition, 4));
    layout.property[kAlpha] = 0;
    EXPECT_TRUE(layout.has(kAlpha, 1));
    EXPECT_FALSE(layout.has(kColor, 4));
}

} // namespace
} // namespace gnomon::read
