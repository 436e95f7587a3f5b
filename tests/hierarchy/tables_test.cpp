// The tables of a .gnm: rows and summaries as bytes, and what is said of each lie in them.
#include "damage_text.h"
#include "hierarchy/file_layout.h"
#include "hierarchy/validation.h"
#include "hierarchy/world_frame.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace gnomon::hierarchy {
namespace {

/// Steps of one.
const Grid kGrid;

/// A page of level 1 refined by two of level 0, `storedBytes` 100 each.
std::vector<PageInfo> threePages() {
    std::vector<PageInfo> pages(3);
    for (std::uint32_t i = 0; i < 3; ++i) {
        PageInfo& page = pages[i];
        page.storedBytes = 100;
        page.offset = kHeaderBytes + 100ULL * i;
        page.checksum = 0x0123456789ABCDEFULL + i;
        page.level = i == 0 ? 1 : 0;
        page.groupCount = 1 + i;
        page.clusterCount = 4 + i;
        page.refinementCount = i == 0 ? 3 : 0;
        page.vertexCount = 10 + i;
        page.triangleCount = 13 + i;
        page.box = {{1 + i, 2, 3}, {40, 50, 60 + i}};
        page.bounds = {{1.5, -2.5, i}, 3.25};
        page.minError = 0.125;
        page.maxError = i == 0 ? std::numeric_limits<double>::infinity() : 0.5;
    }
    pages[0].children = {1, 2};
    return pages;
}

Footer footerOf(std::span<const PageInfo> pages) {
    Footer footer;
    footer.pageCount = pages.size();
    footer.pageTable.offset = kHeaderBytes;
    for (const PageInfo& page : pages)
        footer.pageTable.offset += page.storedBytes;
    return footer;
}

template <class Change>
std::string damageOfTablesAfter(const Change& change) {
    std::vector<PageInfo> pages = threePages();
    Footer footer = footerOf(pages);
    change(pages, footer);
    return damageOf([&] { decodePageTable(encodePageTable(pages), footer, kGrid); });
}

TEST(PageTable, EveryFieldComesBack) {
    const std::vector<PageInfo> pages = threePages();
    const std::vector<PageInfo> back = decodePageTable(encodePageTable(pages), footerOf(pages), kGrid);
    ASSERT_EQ(back.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(back[i].offset, pages[i].offset);
        EXPECT_EQ(back[i].storedBytes, pages[i].storedBytes);
        EXPECT_EQ(back[i].checksum, pages[i].checksum);
        EXPECT_EQ(back[i].level, pages[i].level);
        EXPECT_EQ(back[i].groupCount, pages[i].groupCount);
        EXPECT_EQ(back[i].clusterCount, pages[i].clusterCount);
        EXPECT_EQ(back[i].refinementCount, pages[i].refinementCount);
        EXPECT_EQ(back[i].vertexCount, pages[i].vertexCount);
        EXPECT_EQ(back[i].triangleCount, pages[i].triangleCount);
        EXPECT_EQ(back[i].box.min, pages[i].box.min);
        EXPECT_EQ(back[i].box.max, pages[i].box.max);
        EXPECT_EQ(back[i].bounds.center, pages[i].bounds.center);
        EXPECT_EQ(back[i].bounds.radius, pages[i].bounds.radius);
        EXPECT_EQ(back[i].minError, pages[i].minError);
        EXPECT_EQ(back[i].maxError, pages[i].maxError);
        EXPECT_EQ(back[i].children, pages[i].children);
    }
}

TEST(PageTable, EachLieIsNamed) {
    using Pages = std::vector<PageInfo>;
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(damageOfTablesAfter([](Pages&, Footer&) {}), "");
    const auto isNamed = [](const char* what, auto&& change) {
        const std::string damage = damageOfTablesAfter(change);
        EXPECT_EQ(damage.find(std::string("page 1: ") + what), 0U) << damage;
    };
    for (const double wrong : {kNan, kInfinite, -1.0})
        isNamed("its bounds: expected ", [&](Pages& p, Footer&) { p[1].bounds.radius = wrong; });
    isNamed("its bounds: expected ", [](Pages& p, Footer&) { p[1].bounds.center.z = kNan; });
    isNamed("its errors: expected ", [](Pages& p, Footer&) { p[1].minError = -1; });
    isNamed("its errors: expected ", [](Pages& p, Footer&) { p[1].minError = kNan; });
    isNamed("its errors: expected ", [](Pages& p, Footer&) { p[1].maxError = 0.1; }); // below the least
    isNamed("pages that its 0 refinements name", [](Pages& p, Footer&) { p[1].children = {2}; });
    EXPECT_EQ(
        damageOfTablesAfter([](Pages& p, Footer&) {
            p[0].children = {2, 1};
        }),
        "the children of a page are not sorted");
    EXPECT_EQ(
        damageOfTablesAfter([](Pages& p, Footer&) {
            p[0].children = {1, 1};
        }),
        "the children of a page are not sorted");
    EXPECT_EQ(
        damageOfTablesAfter([](Pages& p, Footer&) { p[2] = p[0]; }), "the pages are not sorted from coarse to fine");
    const std::string notFiner = "the child of a page is not finer than the page";
    EXPECT_EQ(damageOfTablesAfter([](Pages& p, Footer&) { p[0].children = {1, 3}; }), notFiner);
    EXPECT_EQ(damageOfTablesAfter([](Pages& p, Footer&) { p[0].children = {0}; }), notFiner);
    const auto ofItsOwnLevel = [](Pages& p, Footer&) {
        p[1].level = p[1].refinementCount = 1;
        p[1].children = {2};
    };
    EXPECT_EQ(damageOfTablesAfter(ofItsOwnLevel), notFiner);
    const std::string gap = "the page table does not follow the last page";
    EXPECT_EQ(damageOfTablesAfter([](Pages& p, Footer&) { p[2].storedBytes += 1; }), gap);
    EXPECT_EQ(damageOfTablesAfter([](Pages&, Footer& f) { f.pageTable.offset -= 1; }), gap);
    EXPECT_EQ(damageOfTablesAfter([](Pages&, Footer& f) { f.pageCount = 4; }), "the bytes end too early");
    EXPECT_NE(
        damageOfTablesAfter([](Pages&, Footer& f) { f.pageCount = 2; }).find("bytes too many"), std::string::npos);
    EXPECT_EQ(
        damageOfTablesAfter([](Pages&, Footer& f) { f.pageCount = ~std::uint64_t{0}; }), "the bytes end too early");
}

TEST(PageTable, TheLargestSphereAndTheLeastErrorsAreSound) {
    using Pages = std::vector<PageInfo>;
    EXPECT_EQ(damageOfTablesAfter([](Pages& p, Footer&) { p[1].bounds = {{0, 0, 0}, 0}; }), "");
    EXPECT_EQ(damageOfTablesAfter([](Pages& p, Footer&) { p[1].minError = p[1].maxError = 0; }), "");
    EXPECT_EQ(damageOfTablesAfter([](Pages& p, Footer&) { p[1].minError = p[1].maxError; }), "");
    EXPECT_EQ(damageOfTablesAfter([](Pages& p, Footer&) { p[1].bounds = {{0, 0, 0}, 0x1p44}; }), "");
    EXPECT_EQ(damageOfTablesAfter([](Pages& p, Footer&) { p[1].bounds = {{0x1p42, -0x1p42, 0x1p42}, 0x1p42}; }), "");
    EXPECT_NE(damageOfTablesAfter([](Pages& p, Footer&) { p[1].bounds = {{0, 1, 0}, 0x1p44}; }), "");
}

TEST(PageTable, EachCountAddsWhatItMayTakeInPlainBytes) {
    constexpr std::uint64_t kSphereAndErrors = 6 * sizeof(double);
    const auto added = [](const auto& change) {
        PageInfo info;
        const std::uint64_t before = maxPlainBytes(info);
        change(info);
        return maxPlainBytes(info) - before;
    };
    EXPECT_EQ(added([](PageInfo& info) { info.groupCount = 3; }), 3 * (5 + kSphereAndErrors));
    EXPECT_EQ(added([](PageInfo& info) { info.refinementCount = 3; }), 3 * (5 + 5 + kSphereAndErrors));
    EXPECT_EQ(added([](PageInfo& info) { info.clusterCount = 3; }), 3 * (2 + 5 + 15));
    EXPECT_EQ(added([](PageInfo& info) { info.vertexCount = 3; }), 3 * 56);
    EXPECT_EQ(added([](PageInfo& info) { info.triangleCount = 3; }), 3 * 4);
}

TEST(PageTable, NeedsMemoryForItsBytesItsRowsAndTheirChildren) {
    const std::vector<PageInfo> pages = threePages(); // two children in all
    Footer footer = footerOf(pages);
    footer.pageTable.bytes = encodePageTable(pages).size();
    EXPECT_EQ(tableMemory(footer), footer.pageTable.bytes + 3 * sizeof(PageInfo) + 2 * sizeof(std::uint32_t));
}

TEST(PageTable, AChildCountThatLiesAsksForNoMemory) {
    const std::vector<PageInfo> pages = threePages();
    std::vector<std::byte> bytes = encodePageTable(pages);
    constexpr std::size_t kChildCount = 4 + 4 + 8 + 5 * 4 + 6 * 4; // stored bytes, level, checksum, counts, box
    const std::uint32_t lie = 0xFFFFFFFFU;
    std::memcpy(bytes.data() + kChildCount, &lie, sizeof lie);
    EXPECT_NE(damageOf([&] { decodePageTable(bytes, footerOf(pages), kGrid); }), "");
}

ModelSummary someSummary() {
    ModelSummary summary;
    summary.grid = {{1, 2, 3}, -7};
    summary.bounds = {{1, 2, 3}, {4, 5, 6}};
    summary.sourceTriangles = 1000;
    summary.sourceVertices = 600;
    summary.coarsestTriangles = 12;
    summary.hasColors = true;
    summary.dropped = {{"degenerate", 3}, {"doubled", 300}};
    summary.options = {{"error", "measured"}};
    summary.levels = {{900, 20, 5, 0.25}, {400, 10, 3, 0.5, 0.75}};
    summary.up.direction = {0, 0, 1};
    summary.unit = Unit::Foot;
    summary.fields = {{"quality", -1, 2, 8}, {"intensity", 0, 65535, 16}};
    return summary;
}

/// What format 4 appends to the summary: up, unit, no fields, an error for each level.
constexpr std::size_t worldFrameBytes(std::size_t levels) {
    return 3 * sizeof(double) + 2 + levels * sizeof(double);
}

TEST(Summary, ComesBackAndItsFlagsTellWhatVerticesHave) {
    const ModelSummary summary = someSummary();
    const ModelSummary back = decodeSummary(encodeSummary(summary));
    EXPECT_EQ(back.grid.origin, summary.grid.origin);
    EXPECT_EQ(back.grid.stepExponent, -7);
    EXPECT_EQ(back.sourceTriangles, 1000U);
    EXPECT_EQ(back.sourceVertices, 600U);
    EXPECT_EQ(back.coarsestTriangles, 12U);
    EXPECT_FALSE(back.hasNormals);
    EXPECT_TRUE(back.hasColors);
    EXPECT_EQ(back.dropped, summary.dropped);
    EXPECT_EQ(back.options, summary.options);
    ASSERT_EQ(back.levels.size(), 2U);
    EXPECT_EQ(back.levels[1].triangles, 400U);
    EXPECT_EQ(back.levels[1].clusters, 10U);
    EXPECT_EQ(back.levels[1].groups, 3U);
    EXPECT_EQ(back.levels[1].maxError, 0.5);
    EXPECT_EQ(back.levels[1].maxAttributeError, 0.75);
    EXPECT_EQ(back.attributeError(), 0.75);
    EXPECT_EQ(back.up.direction, glm::dvec3(0, 0, 1));
    EXPECT_EQ(back.unit, Unit::Foot);
    EXPECT_EQ(back.fields, summary.fields);
    for (unsigned flags = 0; flags < 4; ++flags) {
        ModelSummary other = summary;
        other.hasNormals = (flags & 1U) != 0;
        other.hasColors = (flags & 2U) != 0;
        EXPECT_EQ(flagsOf(other), flags);
        EXPECT_EQ(decodeSummary(encodeSummary(other)).hasNormals, other.hasNormals);
    }
}

TEST(Summary, OfFormat3HasTheDefaultsOfWhatItDidNotSay) {
    ModelSummary summary = someSummary();
    summary.fields.clear();
    std::vector<std::byte> bytes = encodeSummary(summary);
    EXPECT_EQ(damageOf([&] { decodeSummary(bytes, 3); }), "42 bytes too many");
    bytes.erase(bytes.end() - static_cast<std::ptrdiff_t>(worldFrameBytes(2)), bytes.end());
    const ModelSummary back = decodeSummary(bytes, 3);
    EXPECT_EQ(back.levels[1].maxError, 0.5);
    EXPECT_EQ(back.attributeError(), 0);
    EXPECT_EQ(back.up, UpAxis());
    EXPECT_EQ(back.unit, Unit::Metre);
    EXPECT_TRUE(back.fields.empty());
    EXPECT_EQ(damageOf([&] { decodeSummary(bytes, 4); }), "the bytes end too early");
}

TEST(Summary, EachLieOfFormat4IsNamed) {
    const auto after = [](auto&& change) {
        ModelSummary summary = someSummary();
        change(summary);
        return damageOf([&] { decodeSummary(encodeSummary(summary)); });
    };
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    for (const double wrong : {kNan, 1 / 0.0, -1.0})
        EXPECT_EQ(
            after([&](ModelSummary& s) { s.levels[1].maxAttributeError = wrong; }),
            "an error is negative or not finite");
    for (const double wrong : {kNan, 1 / 0.0, 0.0, 1.1})
        EXPECT_EQ(after([&](ModelSummary& s) { s.up.direction.z = wrong; }), "the up direction is not a unit vector");
    EXPECT_EQ(after([](ModelSummary& s) { s.up.direction = {0.6, 0, -0.8}; }), "");
    EXPECT_EQ(after([](ModelSummary& s) { s.unit = static_cast<Unit>(5); }), "unit 5 is unknown");
    const std::string unnamed = "a field has no name or no range";
    EXPECT_EQ(after([](ModelSummary& s) { s.fields[1].name.clear(); }), unnamed);
    EXPECT_EQ(after([](ModelSummary& s) { s.fields[1].min = 65536; }), unnamed);
    for (const double wrong : {kNan, 1 / 0.0})
        EXPECT_EQ(after([&](ModelSummary& s) { s.fields[0].max = wrong; }), unnamed);
    EXPECT_EQ(after([](ModelSummary& s) { s.fields[1].min = 65535; }), "");
    EXPECT_EQ(after([](ModelSummary& s) { s.fields[1].bits = 0; }), "a field has 0 bits");
    EXPECT_EQ(after([](ModelSummary& s) { s.fields[1].bits = 17; }), "a field has 17 bits");
    EXPECT_EQ(
        after([](ModelSummary& s) {
            s.fields.resize(5, {"more", 0, 1, 1});
        }),
        "fields: expected at most 4 of 32 bits together, found 5 of 26");
    EXPECT_EQ(
        after([](ModelSummary& s) {
            s.fields = {{"a", 0, 1, 16}, {"b", 0, 1, 16}, {"c", 0, 1, 1}};
        }),
        "fields: expected at most 4 of 32 bits together, found 3 of 33");
    // Five bytes that promise 2^32 fields: the bytes that are there bound how many are taken.
    std::vector<std::byte> bytes = encodeSummary(someSummary());
    const std::size_t count = bytes.size() - 2 * sizeof(double) - std::size_t{2} * 17 - 8 - 10 - 1;
    ASSERT_EQ(bytes[count], std::byte{2});
    const std::array<std::byte, 5> many = {
        std::byte{0x80}, std::byte{0x80}, std::byte{0x80}, std::byte{0x80}, std::byte{0x10}};
    bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(count));
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(count), many.begin(), many.end());
    EXPECT_NE(damageOf([&] { decodeSummary(bytes); }), "");
}

TEST(WorldFrame, NamesAreThoseOfOptionsAndLengthsThoseOfTheirDefinitions) {
    for (const char* name : {"x", "y", "z", "-x", "-y", "-z"}) {
        ASSERT_TRUE(upAxisNamed(name));
        EXPECT_EQ(upAxisText(*upAxisNamed(name)), name);
    }
    EXPECT_EQ(upAxisNamed("y"), UpAxis());
    EXPECT_EQ(upAxisNamed("-x")->direction, glm::dvec3(-1, 0, 0));
    EXPECT_FALSE(upAxisNamed("up"));
    EXPECT_EQ(upAxisText({{0.6, 0, -0.8}}), "0.6,0,-0.8");
    for (const UnitRow& row : kUnits) {
        EXPECT_EQ(unitNamed(row.name), row.unit);
        EXPECT_EQ(rowOf(row.unit).name, row.name);
    }
    EXPECT_FALSE(unitNamed("km"));
    EXPECT_DOUBLE_EQ(rowOf(Unit::Inch).metres * 12, rowOf(Unit::Foot).metres);
}

TEST(Summary, EachLieIsNamed) {
    const auto after = [](auto&& change) {
        ModelSummary summary = someSummary();
        change(summary);
        return damageOf([&] { decodeSummary(encodeSummary(summary)); });
    };
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(after([](ModelSummary& s) { s.levels[0].maxError = kNan; }), "an error is negative or not finite");
    EXPECT_EQ(after([](ModelSummary& s) { s.levels[1].maxError = -1; }), "an error is negative or not finite");
    EXPECT_EQ(after([](ModelSummary& s) { s.levels[1].maxError = 1 / 0.0; }), "an error is negative or not finite")
        << "finite, too";
    EXPECT_EQ(after([](ModelSummary& s) { s.grid.origin.y = kNan; }).find("the grid's origin: expected "), 0U);
    for (const int exponent : {kMinStepExponent - 1, kMaxStepExponent + 1})
        EXPECT_EQ(after([&](ModelSummary& s) { s.grid.stepExponent = exponent; }).find("the grid's step"), 0U);
    for (const int exponent : {-29, kMaxStepExponent})
        EXPECT_EQ(after([&](ModelSummary& s) { s.grid.stepExponent = exponent; }), "");
    EXPECT_EQ(after([](ModelSummary& s) { s.bounds.max.x = kNan; }).find("the bounds: expected "), 0U);
    std::vector<std::byte> bytes = encodeSummary(someSummary());
    bytes.push_back(std::byte{0});
    EXPECT_EQ(damageOf([&] { decodeSummary(bytes); }), "1 bytes too many");
    // Two names of a map the other way round: the same map may have one form only.
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size() - 1);
    const std::size_t first = text.find("degenerate");
    text.replace(first, 10, "zegenerate");
    EXPECT_EQ(damageOf([&] { decodeSummary(std::as_bytes(std::span(text))); }), "the names are not sorted");
}

TEST(Footer, ComesBackAndKnowsEachOfItsBytes) {
    const Footer footer{{40, 50, 60}, {90, 70, 80}, 1234, 5};
    const std::vector<std::byte> bytes = encodeFooter(footer);
    ASSERT_EQ(bytes.size(), kFooterBytes);
    const Footer back = decodeFooter(bytes);
    EXPECT_EQ(back.pageTable.offset, 40U);
    EXPECT_EQ(back.pageTable.bytes, 50U);
    EXPECT_EQ(back.pageTable.checksum, 60U);
    EXPECT_EQ(back.summary.offset, 90U);
    EXPECT_EQ(back.summary.bytes, 70U);
    EXPECT_EQ(back.summary.checksum, 80U);
    EXPECT_EQ(back.fileBytes, 1234U);
    EXPECT_EQ(back.pageCount, 5U);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::vector<std::byte> bad = bytes;
        bad[i] ^= std::byte{1};
        EXPECT_EQ(damageOf([&] { decodeFooter(bad); }), "the footer's checksum is wrong") << i;
    }
}

TEST(Header, BeginsWithTheMagicAndEndsWithTheHash) {
    ContentHash hash{};
    hash[0] = std::byte{0xAB};
    hash[15] = std::byte{0x0F};
    EXPECT_EQ(hexText(hash), "ab00000000000000000000000000000f");
    const std::vector<std::byte> header = encodeHeader(3, hash);
    ASSERT_EQ(header.size(), kHeaderBytes);
    EXPECT_EQ(header[0], std::byte{0x89});
    EXPECT_EQ(header[8], std::byte{kFormatVersion});
    EXPECT_EQ(header[12], std::byte{3});
    EXPECT_TRUE(std::equal(hash.begin(), hash.end(), header.begin() + kHashOffset));
    EXPECT_NE(encodeHeader(2, hash), header);
    EXPECT_NE(encodeHeader(3, hash, 3), header);
    hash[15] = std::byte{0x0E};
    const std::vector<std::byte> other = encodeHeader(3, hash);
    EXPECT_FALSE(std::equal(other.begin() + 16, other.begin() + 24, header.begin() + 16))
        << "the checksum covers the hash";
}

} // namespace
} // namespace gnomon::hierarchy
