// Pages forged by hand, one lie each: what the decoder says of it. No checksum stands in the way here.
#include "damage_text.h"
#include "hierarchy/codec/cluster_codec.h"
#include "hierarchy/page_codec.h"
#include "hierarchy/validation.h"

#include <gtest/gtest.h>

#include <limits>

namespace gnomon::hierarchy {
namespace {

/// One triangle in each of two clusters of one group, with a refinement each.
Page smallPage() {
    Page page;
    page.level = 1;
    page.refinements = {{{7, 3}, {{1, 2, 3}, 4}, 0.25}, {{9, 0}, {{0, 0, 0}, 1}, 0.125}};
    for (std::uint32_t c = 0; c < 2; ++c) {
        Cluster cluster{3 * c, c, 3, 1, c, {}};
        for (std::uint32_t v = 0; v < 3; ++v) {
            page.vertices.push_back({{10 * c + v, v * v, 5}, kNoNormal, 0xFFFFFFFFU});
            cluster.box.add(page.vertices.back().position);
        }
        page.triangles.push_back({0, 1, 2});
        page.clusters.push_back(cluster);
    }
    Group group{0, 2, page.clusters[0].box, {{1, 1, 1}, 9}, 0.5};
    group.box.add(page.clusters[1].box);
    page.groups = {group};
    return page;
}

/// The plain bytes of `smallPage`, value by value, so that each can be a lie.
struct Forged {
    std::uint64_t groupClusters = 2;
    double groupRadius = 9;
    double groupError = 0.5;
    std::uint64_t child = 0;
    std::uint64_t childGroup = 3;
    double refinementCenter = 1;
    double refinementError = 0.25;
    std::uint64_t refinement = 0;
    std::uint8_t vertices = 3;
    std::string more; // at the end

    std::vector<std::byte> bytes() const {
        const Page page = smallPage();
        ByteWriter out;
        out.putVarint(groupClusters);
        putSphere(out, {{1, 1, 1}, groupRadius});
        out.put(groupError);
        out.putVarint(child);
        out.putVarint(childGroup);
        putSphere(out, {{refinementCenter, 2, 3}, 4});
        out.put(refinementError);
        out.putVarint(1);
        out.putVarint(0);
        putSphere(out, {{0, 0, 0}, 1});
        out.put(0.125);
        for (std::uint64_t c = 0; c < 2; ++c) {
            out.put(static_cast<std::uint8_t>((c == 0 ? vertices : 3) - 1));
            out.put(std::uint8_t{0});
            out.putVarint(c == 0 ? refinement : 1);
        }
        encodeClusters(page, out);
        out.put(std::as_bytes(std::span(more)));
        return out.take();
    }

    static void putSphere(ByteWriter& out, const Sphere& sphere) {
        for (const double value : {sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius})
            out.put(value);
    }
};

std::vector<std::byte> stored(std::uint8_t packing, std::uint64_t aliasingBound, std::span<const std::byte> bytes) {
    ByteWriter out;
    out.put(packing);
    out.putVarint(aliasingBound);
    out.put(bytes);
    return out.take();
}

std::string damageOfForged(const Forged& forged, const PageInfo& info = describePage(smallPage())) {
    const std::vector<std::byte> plain = forged.bytes();
    return damageOf([&] { decodePageBytes(stored(0, plain.size(), plain), info); });
}

template <class Change>
std::string damageAfter(const Change& change) {
    Forged forged;
    change(forged);
    return damageOfForged(forged);
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(PageDamage, FieldsThatCannotBeAreNamed) {
    const auto after = [](std::initializer_list<int> tail, std::uint8_t packing = 4) {
        std::vector<std::byte> plain = Forged{}.bytes();
        for (const int byte : tail)
            plain.push_back(static_cast<std::byte>(byte));
        return damageOf([&] { decodePageBytes(stored(packing, plain.size(), plain), describePage(smallPage())); });
    };
    EXPECT_EQ(after({1, 16, 0}), "");
    EXPECT_EQ(after({2, 1, 16, 0, 1, 1, 2, 3, 4, 5, 6}), "");
    EXPECT_EQ(after({}), "the bytes end too early");
    EXPECT_EQ(after({0}), "vertices have 0 fields");
    EXPECT_EQ(after({5, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0}), "vertices have 5 fields");
    EXPECT_EQ(after({1, 0, 0}), "a field has too many bits, or none");
    EXPECT_EQ(after({1, 17, 0}), "a field has too many bits, or none");
    EXPECT_EQ(after({3, 16, 16, 1, 0, 0, 0}), "fields have more than 32 bits together");
    EXPECT_EQ(after({1, 16, 1, 2, 3, 4, 5, 6}), "the bytes end too early");
    EXPECT_EQ(after({1, 16, 5}), "a value has more than four bytes");
    EXPECT_EQ(after({1, 16, 0, 0}), "1 bytes too many");
    EXPECT_EQ(after({1, 16, 0}, 0), "3 bytes too many");
    EXPECT_EQ(after({1, 16, 0}, 8), "unknown packing");
}

TEST(PageDamage, TheForgedPageItselfIsSound) {
    const std::vector<std::byte> plain = Forged{}.bytes();
    const Page page = decodePageBytes(stored(0, plain.size(), plain), describePage(smallPage()));
    EXPECT_EQ(pageFault(page), std::nullopt);
    EXPECT_EQ(page.refinements[0].group, (GroupRef{7, 3}));
    EXPECT_EQ(page.refinements[1].group, (GroupRef{9, 0}));
}

TEST(PageDamage, CountsAndIndicesOutOfRangeAreNamed) {
    const std::string noClusters = "a group refers to missing clusters";
    EXPECT_EQ(damageAfter([](Forged& f) { f.groupClusters = 0; }), noClusters);
    EXPECT_EQ(damageAfter([](Forged& f) { f.groupClusters = 3; }), noClusters);
    EXPECT_EQ(damageAfter([](Forged& f) { f.groupClusters = 1; }), "a cluster has no group");
    EXPECT_EQ(damageAfter([](Forged& f) { f.groupClusters = kNone; }), "an index has more than 32 bits");
    EXPECT_EQ(damageAfter([](Forged& f) { f.groupClusters = kNone - 1; }), noClusters);
    EXPECT_EQ(damageAfter([](Forged& f) { f.child = 2; }), "a refinement refers to a missing child page");
    EXPECT_EQ(damageAfter([](Forged& f) { f.childGroup = std::uint64_t{1} << 32U; }), "an index has more than 32 bits");
    EXPECT_EQ(damageAfter([](Forged& f) { f.refinement = 2; }), "a cluster names a refinement out of range");
    EXPECT_EQ(damageAfter([](Forged& f) { f.vertices = 4; }), "the counts of the clusters differ from the page table");
}

TEST(PageDamage, BoundsAndErrorsThatAreNoNumbersAreNamed) {
    for (const double wrong : {kNan, kInfinite, -kInfinite, -1.0})
        EXPECT_EQ(damageAfter([&](Forged& f) { f.groupRadius = wrong; }), "a bounding sphere is invalid") << wrong;
    for (const double wrong : {kNan, kInfinite, -kInfinite})
        EXPECT_EQ(damageAfter([&](Forged& f) { f.refinementCenter = wrong; }), "a bounding sphere is invalid") << wrong;
    for (const double wrong : {kNan, -kInfinite, -1e-300})
        EXPECT_EQ(damageAfter([&](Forged& f) { f.groupError = wrong; }), "an error is negative or not finite") << wrong;
    for (const double wrong : {kNan, kInfinite, -1e-300})
        EXPECT_EQ(damageAfter([&](Forged& f) { f.refinementError = wrong; }), "an error is negative or not finite")
            << wrong;
    EXPECT_EQ(damageAfter([](Forged& f) { f.groupError = kInfinite; }), "bounds or errors differ from the page table")
        << "a root's error is a number, if not this page's";
    EXPECT_EQ(damageAfter([](Forged& f) { f.groupError = 0; }), "bounds or errors differ from the page table");
}

TEST(PageDamage, WhatIsLeftOverIsNamed) {
    EXPECT_EQ(damageAfter([](Forged& f) { f.more = "x"; }), "1 bytes too many");
    const std::vector<std::byte> plain = Forged{}.bytes();
    for (std::size_t size = 0; size < plain.size(); ++size)
        EXPECT_NE(
            damageOf(
                [&] { decodePageBytes(stored(0, size, std::span(plain).first(size)), describePage(smallPage())); }),
            "")
            << size;
}

TEST(PageDamage, EveryFieldOfTheRowIsCompared) {
    const auto after = [](auto&& change) {
        PageInfo info = describePage(smallPage());
        change(info);
        return damageOfForged(Forged{}, info);
    };
    const std::string differs = "bounds or errors differ from the page table";
    EXPECT_EQ(after([](PageInfo&) {}), "");
    EXPECT_EQ(after([](PageInfo& i) { i.box.min.x += 1; }), differs);
    EXPECT_EQ(after([](PageInfo& i) { i.box.max.z += 1; }), differs);
    EXPECT_EQ(after([](PageInfo& i) { i.bounds.center.y += 1; }), differs);
    EXPECT_EQ(after([](PageInfo& i) { i.bounds.radius += 1; }), differs);
    EXPECT_EQ(after([](PageInfo& i) { i.minError = 0; }), differs);
    EXPECT_EQ(after([](PageInfo& i) { i.maxError = 1; }), differs);
    EXPECT_EQ(after([](PageInfo& i) { i.children.push_back(11); }), differs);
    EXPECT_EQ(after([](PageInfo& i) { i.children.pop_back(); }), "a refinement refers to a missing child page");
    EXPECT_EQ(after([](PageInfo& i) { i.children = {8, 9}; }), "") << "its place among the children is what is stored";
    PageInfo none;
    none.level = 1;
    EXPECT_EQ(
        damageOf([&] { decodePageBytes(stored(0, 0, {}), none); }),
        "groups of 0 clusters: expected 1 to as many, found 0");
}

TEST(PageDamage, APromiseThatTheBytesCannotKeepIsRefusedBeforeMemoryIsAskedFor) {
    const PageInfo info = describePage(smallPage());
    const std::vector<std::byte> plain = Forged{}.bytes();
    const auto damage = [&](std::uint8_t packing, std::uint64_t aliasingBound, std::span<const std::byte> bytes) {
        return damageOf([&] { decodePageBytes(stored(packing, aliasingBound, bytes), info); });
    };
    EXPECT_EQ(damage(0, plain.size() + 1, plain), "the stored size differs from the page table");
    for (const int packing : {8, 9, 255})
        EXPECT_EQ(damage(static_cast<std::uint8_t>(packing), plain.size(), plain), "unknown packing");
    EXPECT_EQ(damage(1, 256 * plain.size() + 1, plain), "the decompressed size is too large for the stored bytes");
    EXPECT_EQ(damage(1, ~std::uint64_t{0}, plain), "the decompressed size is too large for the stored bytes");
    EXPECT_EQ(damage(1, plain.size(), plain).find("cannot decompress: "), 0U);
    EXPECT_EQ(damageOf([&] { decodePageBytes({}, info); }), "the bytes end too early");
}

} // namespace
} // namespace gnomon::hierarchy
