// Byte streams: what goes in comes out, and nothing is read past the end.
#include "core/random.h"
#include "damage_text.h"
#include "hierarchy/bytes.h"

#include <gtest/gtest.h>

#include <array>

namespace gnomon::hierarchy {
namespace {

TEST(Bytes, ValuesComeOutAsTheyWentInLittleEndFirst) {
    ByteWriter out;
    out.put(std::uint32_t{0x01020304});
    out.put(std::uint8_t{0xAB});
    out.put(-1.5);
    out.putText("two words");
    out.putText("");
    EXPECT_EQ(out.size(), 1U + 4 + 8 + 10 + 1);
    EXPECT_EQ(out.bytes()[0], std::byte{4}) << "the low byte comes first";
    ByteReader in(out.bytes());
    EXPECT_EQ(in.take<std::uint32_t>(), 0x01020304U);
    EXPECT_EQ(in.take<std::uint8_t>(), 0xAB);
    EXPECT_EQ(in.take<double>(), -1.5);
    EXPECT_EQ(in.takeText(), "two words");
    EXPECT_EQ(in.remaining(), 1U);
    EXPECT_EQ(in.takeText(), "");
    in.expectEnd();
}

TEST(Bytes, AVarintTakesSevenBitsAByte) {
    const auto length = [](std::uint64_t value) {
        ByteWriter out;
        out.putVarint(value);
        ByteReader in(out.bytes());
        EXPECT_EQ(in.takeVarint(), value);
        in.expectEnd();
        return out.size();
    };
    for (unsigned bits = 0; bits < 64; ++bits) {
        const std::uint64_t value = std::uint64_t{1} << bits;
        EXPECT_EQ(length(value), bits / 7 + 1) << bits;
        EXPECT_EQ(length(value - 1), bits == 0 ? 1 : (bits - 1) / 7 + 1) << bits;
    }
    EXPECT_EQ(length(~std::uint64_t{0}), 10U);
    Random random(1);
    for (int i = 0; i < 1000; ++i)
        length(random.bits() >> random.below(64));
}

TEST(Bytes, NothingIsReadPastTheEnd) {
    const std::array<std::byte, 3> three{};
    EXPECT_EQ(damageOf([&] { ByteReader(three).take<std::uint32_t>(); }), "the bytes end too early");
    EXPECT_EQ(damageOf([&] { ByteReader(three).take(4); }), "the bytes end too early");
    EXPECT_EQ(damageOf([&] { ByteReader(three).take(~std::size_t{0}); }), "the bytes end too early");
    EXPECT_EQ(damageOf([&] { ByteReader(three).take(3); }), "");
    EXPECT_EQ(damageOf([&] { ByteReader(three).expectEnd(); }), "3 bytes too many");
    ByteWriter text;
    text.putText("hello");
    EXPECT_EQ(damageOf([&] { ByteReader(std::span(text.bytes()).first(5)).takeText(); }), "the bytes end too early");
    std::array<std::byte, 11> ones{};
    ones.fill(std::byte{0x80});
    EXPECT_EQ(damageOf([&] { ByteReader(ones).takeVarint(); }), "a number has more than 64 bits");
    EXPECT_EQ(damageOf([&] { ByteReader(std::span(ones).first(9)).takeVarint(); }), "the bytes end too early");
}

TEST(Bytes, RoomIsFilledByTheCaller) {
    ByteWriter out;
    out.put(std::uint16_t{0x0100});
    const std::span<std::byte> room = out.room(2);
    ASSERT_EQ(room.size(), 2U);
    room[0] = std::byte{2};
    room[1] = std::byte{3};
    out.put(std::uint8_t{4});
    const std::vector<std::byte> expected{std::byte{0}, std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}};
    EXPECT_EQ(out.bytes(), expected);
    EXPECT_EQ(out.take(), expected);
}

} // namespace
} // namespace gnomon::hierarchy
