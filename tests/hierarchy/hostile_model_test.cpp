// Models that claim what cannot be, checksums and all: refused in words, before memory is asked for.
#include "core/error.h"
#include "hierarchy/file_layout.h"
#include "hierarchy/model_file.h"
#include "hierarchy/model_writer.h"
#include "hierarchy/page_codec.h"
#include "hierarchy/validation.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <functional>

namespace gnomon::hierarchy {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Tests run side by side, so each has a file of its own.
std::string pathOfTest() {
    const char* test = testing::UnitTest::GetInstance()->current_test_info()->name();
    return testing::TempDir() + "gnomon_" + test + ".gnm";
}

/// A model between its making and its file, where everything can be made a lie that the checksums cover.
struct Sealed {
    /// Sound as yet.
    static const Sealed& sound() {
        static const Sealed made = [] {
            const tests::TinyModel model = tests::makeTinyModel({});
            Sealed sealed{{}, model.summary};
            for (const Page& page : model.pages)
                sealed.pages.push_back(encodePage(page));
            return sealed;
        }();
        return made;
    }

    /// Puts it to `path`, all checksums sound but that of the contents, which opening does not look at.
    void write(const std::string& path) const {
        File file(path, File::Mode::Create);
        file.writeAt(0, encodeHeader(flagsOf(summary), {}));
        std::uint64_t offset = kHeaderBytes;
        const auto append = [&](std::span<const std::byte> bytes) {
            file.writeAt(offset, bytes);
            const TablePlace place{offset, bytes.size(), checksum64(bytes)};
            offset += bytes.size();
            return place;
        };
        std::vector<PageInfo> rows;
        for (const EncodedPage& page : pages) {
            append(page.bytes);
            rows.push_back(page.info);
        }
        Footer footer;
        footer.pageTable = append(encodePageTable(rows));
        footer.summary = append(encodeSummary(summary));
        footer.pageCount = rows.size();
        footer.fileBytes = offset + kFooterBytes;
        append(encodeFooter(footer));
    }

    /// Some page of level 0 and the first, which holds the root.
    PageInfo& finest() { return pages.back().info; }

    PageInfo& root() { return pages.front().info; }

    std::vector<EncodedPage> pages;
    ModelSummary summary;
};

/// What opening the model after `change`, and reading its pages, throws; empty if nothing.
std::string refusal(const std::function<void(Sealed&)>& change, Bytes tableMemory = {kMaxTableBytes}) {
    Sealed sealed = Sealed::sound();
    change(sealed);
    const std::string path = pathOfTest();
    sealed.write(path);
    try {
        const ModelFile file(path, tableMemory);
        for (std::uint32_t page = 0; page < file.pages().size(); ++page)
            file.readPage(page);
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_EQ(text.find(path + ": byte "), 0U) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        return text.substr(path.size());
    }
    return {};
}

void expectRefused(const std::string& said, const std::function<void(Sealed&)>& change) {
    const std::string text = refusal(change);
    EXPECT_NE(text.find(said), std::string::npos) << "expected " << said << ", found '" << text << "'";
    EXPECT_NE(text.find("expected "), std::string::npos) << text;
    EXPECT_NE(text.find(", found "), std::string::npos) << text;
}

TEST(HostileModel, AnHonestOneIsRead) {
    EXPECT_EQ(refusal([](Sealed&) {}), "");
}

TEST(HostileModel, NoPageOrNoRootIsRefused) {
    expectRefused("pages: expected at least 1, found none", [](Sealed& s) { s.pages.clear(); });
    expectRefused("root group", [](Sealed& s) { s.root().minError = s.root().maxError = 1; });
}

TEST(HostileModel, LevelsThatAreNotThoseOfThePagesAreRefused) {
    expectRefused("levels of the pages", [](Sealed& s) { s.summary.levels.pop_back(); });
    expectRefused("levels of the pages", [](Sealed& s) { s.summary.levels.emplace_back(); });
    expectRefused("levels: expected 1 to 64", [](Sealed& s) { s.summary.levels.clear(); });
    expectRefused("levels: expected 1 to 64", [](Sealed& s) { s.summary.levels.resize(65); });
    expectRefused("its level: expected less than 64", [](Sealed& s) {
        for (EncodedPage& page : s.pages)
            page.info.level <<= 24U;
    });
    expectRefused("levels of the pages", [](Sealed& s) {
        for (EncodedPage& page : s.pages)
            page.info.level += page.info.level > 0 ? 3 : 0;
    });
}

TEST(HostileModel, GridsAndBoundsBeyondDoublesAreRefused) {
    for (const int exponent : {-2000, -1074, -601, 321, 1000, 2000})
        expectRefused("the grid's step", [=](Sealed& s) { s.summary.grid.stepExponent = exponent; });
    for (const double x : {kNan, kInfinite, 1e300})
        expectRefused("the grid's origin", [=](Sealed& s) { s.summary.grid.origin.x = x; });
    for (const double z : {kNan, kInfinite, -kInfinite, 1e300})
        expectRefused("the bounds", [=](Sealed& s) { s.summary.bounds.max.z = z; });
    expectRefused("the bounds", [](Sealed& s) { std::swap(s.summary.bounds.min.x, s.summary.bounds.max.x); });
}

// The numbers of the pages then mean other lengths than the errors and bounds do.
TEST(HostileModel, AGridThatIsNotThatOfThePagesIsRefused) {
    for (const int exponent : {-300, -60})
        expectRefused("the bounds", [=](Sealed& s) { s.summary.grid.stepExponent = exponent; });
    for (const int exponent : {0, 60, 300})
        expectRefused("box in the world", [=](Sealed& s) { s.summary.grid.stepExponent = exponent; });
}

TEST(HostileModel, BoundsThatCutThePagesOffOnAnySideAreRefused) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto extent = [=](const Sealed& s) { return s.summary.bounds.max[axis] - s.summary.bounds.min[axis]; };
        expectRefused("box in the world", [=](Sealed& s) { s.summary.bounds.max[axis] -= extent(s) / 16; });
        expectRefused("box in the world", [=](Sealed& s) { s.summary.bounds.min[axis] += extent(s) / 16; });
        const auto moved = [=](Sealed& s) {
            s.summary.grid.origin[axis] += 1000;
            s.summary.bounds.min[axis] += 1000;
            s.summary.bounds.max[axis] += 1000;
        };
        EXPECT_EQ(refusal(moved), "") << "wherever the origin is";
    }
}

TEST(HostileModel, BoxesAndSpheresThatAreNoneAreRefused) {
    expectRefused("its box along x", [](Sealed& s) { std::swap(s.root().box.min.x, s.root().box.max.x); });
    expectRefused("its box along y", [](Sealed& s) { s.finest().box.max.y = 0x80000000U; });
    expectRefused("its box along x", [](Sealed& s) { s.finest().box = {}; });
    for (const double x : {kNan, kInfinite, 1e300})
        expectRefused("its bounds", [=](Sealed& s) { s.finest().bounds.center.x = x; });
    for (const double radius : {kNan, kInfinite, 1e300, -1.0})
        expectRefused("its bounds", [=](Sealed& s) { s.finest().bounds.radius = radius; });
    expectRefused("its errors", [](Sealed& s) { s.finest().minError = kNan; });
    expectRefused("its errors", [](Sealed& s) { s.finest().maxError = kNan; });
    expectRefused("its errors", [](Sealed& s) { s.finest().minError = -1; });
    expectRefused("its errors", [](Sealed& s) { s.finest().maxError = s.finest().minError / 2; });
}

TEST(HostileModel, CountsThatNoPageHasAreRefused) {
    for (const std::uint32_t count : {0U, 0xFFFFFFFFU}) {
        expectRefused("groups of", [=](Sealed& s) { s.finest().groupCount = count; });
        expectRefused("vertices of", [=](Sealed& s) { s.finest().vertexCount = count; });
        expectRefused("triangles of", [=](Sealed& s) { s.finest().triangleCount = count; });
        expectRefused(" of ", [=](Sealed& s) { s.finest().clusterCount = count; });
    }
    expectRefused("refinements at level 0", [](Sealed& s) { s.finest().refinementCount = 1; });
    expectRefused("refinements at level", [](Sealed& s) { s.root().refinementCount = 0; });
    expectRefused("pages that its", [](Sealed& s) { s.root().children.clear(); });
    expectRefused("its stored bytes", [](Sealed& s) { s.root().storedBytes = 3'000'000'000; });
}

/// `value` in four bytes, seven bits each.
std::array<std::uint8_t, 4> longVarint(std::uint64_t value) {
    const auto byte = [value](unsigned place) { return static_cast<std::uint8_t>(value >> (7 * place) & 0x7FU); };
    const auto more = [&](unsigned place) { return static_cast<std::uint8_t>(byte(place) | 0x80U); };
    return {more(0), more(1), more(2), byte(3)};
}

/// The stored form of one group of `clusters` clusters, all of `vertices` vertices and a triangle, with nothing behind.
std::vector<std::byte> tablesOf(std::uint32_t clusters, std::uint32_t vertices) {
    constexpr std::size_t kStart = 5; // packing and size
    constexpr std::size_t kGroup = 4 + 5 * sizeof(double);
    std::vector<std::byte> stored(kStart + kGroup + std::size_t{2} * clusters);
    const auto size = longVarint(stored.size() - kStart);
    std::memcpy(&stored[1], size.data(), size.size());
    const auto count = longVarint(clusters);
    std::memcpy(&stored[kStart], count.data(), count.size());
    for (std::size_t c = 0; c < clusters; ++c)
        stored[kStart + kGroup + 2 * c] = static_cast<std::byte>(vertices - 1);
    return stored;
}

// 2^24 + 1 clusters of 256 vertices are 256 vertices in 32 bits: room for one cluster was once made, and all written.
TEST(HostileModel, CountsWhoseSumWrapsAreRefused) {
    PageInfo info;
    info.groupCount = 1;
    info.clusterCount = (1U << 24U) + 1;
    info.vertexCount = 256;
    info.triangleCount = info.clusterCount;
    EXPECT_THROW(decodePageBytes(tablesOf(info.clusterCount, 256), info), Damage);
}

TEST(HostileModel, ClustersWithMoreThanTheRowSaysAreRefused) {
    PageInfo info;
    info.groupCount = 1;
    info.clusterCount = 10;
    info.triangleCount = 10;
    for (const std::uint32_t vertices : {10U, 100U}) {
        info.vertexCount = vertices;
        EXPECT_THROW(decodePageBytes(tablesOf(10, 256), info), Damage);
    }
}

/// A sound page of `clusters` clusters that are all the same.
Page repeated(std::uint32_t clusters) {
    const Vertex vertex{{1, 2, 3}};
    Page page;
    page.groups.push_back({0, clusters, {}, {glm::dvec3(0), 1}});
    for (std::uint32_t c = 0; c < clusters; ++c) {
        page.clusters.push_back({c * kMaxClusterVertices, c, kMaxClusterVertices, 1, kNone, {}});
        page.clusters.back().box.add(vertex.position);
        page.vertices.insert(page.vertices.end(), kMaxClusterVertices, vertex);
        page.triangles.push_back({0, 1, 2});
    }
    page.groups[0].box.add(page.clusters[0].box);
    return page;
}

// A thousandth of what such a page decodes to lies in the file.
TEST(HostileModel, APageThatDecodesToMoreThanAnyWriterPutsInOneIsRefused) {
    const auto only = [](std::uint32_t clusters) {
        return [clusters](Sealed& s) {
            s.pages = {encodePage(repeated(clusters))};
            s.summary.levels.resize(1);
            s.summary.grid.origin = s.summary.bounds.min = s.summary.bounds.max = glm::dvec3(0);
            s.summary.bounds.max += s.summary.grid.step() * 4;
        };
    };
    EXPECT_EQ(refusal(only(700)), "");
    expectRefused("its bytes once decoded: expected at most 4194304", only(1000));
}

TEST(HostileModel, UnpackedBytesBeyondWhatTheCountsTakeAreRefused) {
    const EncodedPage page = encodePage(repeated(2));
    std::vector<std::byte> stored(1000);
    stored[0] = std::byte{1}; // zstd
    const auto size = longVarint(200'000);
    std::memcpy(&stored[1], size.data(), size.size());
    EXPECT_THROW(decodePageBytes(stored, page.info), Damage);
}

/// A file of `bytes` without contents, but for a header and a footer with sound checksums.
std::string sparseModel(std::uint64_t bytes, Footer footer) {
    std::string path = pathOfTest();
    File file(path, File::Mode::Create);
    file.resize(bytes);
    file.writeAt(0, encodeHeader(0, {}));
    footer.fileBytes = bytes;
    file.writeAt(bytes - kFooterBytes, encodeFooter(footer));
    return path;
}

std::string openingFault(const std::string& path, Bytes tableMemory = {kMaxTableBytes}) {
    try {
        const ModelFile file(path, tableMemory);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(HostileModel, TablesBeyondTheMemoryOrTheFileAreNotRead) {
    constexpr std::uint64_t kBytes = 3ULL << 30U;
    constexpr std::uint64_t kPages = 1U << 20U; // bytes
    Footer footer;
    footer.pageTable = {kPages, kBytes - kFooterBytes - kPages - 100, 0};
    footer.summary = {kBytes - kFooterBytes - 100, 100, 0};
    footer.pageCount = 1000;
    EXPECT_NE(
        openingFault(sparseModel(kBytes, footer)).find("expected at most 512.00 MiB, found 6.00 GiB"),
        std::string::npos);
    footer.pageCount = kPages;
    EXPECT_NE(openingFault(sparseModel(kBytes, footer)).find("as many as the file has bytes for"), std::string::npos);
    footer.pageTable.bytes = 112 * footer.pageCount - 1;
    footer.summary = {footer.pageTable.offset + footer.pageTable.bytes, 0, 0};
    footer.summary.bytes = kBytes - kFooterBytes - footer.summary.offset;
    EXPECT_NE(openingFault(sparseModel(kBytes, footer)).find("as many as the file has bytes for"), std::string::npos);
    footer.pageCount = 1000;
    EXPECT_NE(openingFault(sparseModel(kBytes, footer)).find("bytes of the summary"), std::string::npos);
    std::filesystem::remove(pathOfTest());
}

TEST(HostileModel, TheTableOfASmallModelNeedsLittleMemory) {
    EXPECT_NE(
        refusal([](Sealed&) {}, {1000}).find("the page table is larger than the memory for pages"), std::string::npos);
    EXPECT_EQ(refusal([](Sealed&) {}, {64U << 10U}), "");
}

TEST(HostileModel, WhatFloatsCannotHoldIsNotDrawn) {
    const Sealed& sealed = Sealed::sound();
    std::vector<PageInfo> pages;
    for (const EncodedPage& page : sealed.pages)
        pages.push_back(page.info);
    Grid grid = sealed.summary.grid;
    EXPECT_EQ(drawingFault(pages, grid), std::nullopt);
    grid.stepExponent = -126; // the least normal float
    EXPECT_EQ(drawingFault(pages, grid), std::nullopt);
    for (const int exponent : {-127, -500, 60, 300}) {
        grid.stepExponent = exponent;
        EXPECT_NE(drawingFault(pages, grid).value_or("").find("to be drawn"), std::string::npos) << exponent;
    }
}

} // namespace
} // namespace gnomon::hierarchy
