// What the writer writes the reader reads, and nothing else: every mutation and every cut-off file is refused.
#include "core/error.h"
#include "core/random.h"
#include "hierarchy/file_layout.h"
#include "hierarchy/model_file.h"
#include "hierarchy/model_text.h"
#include "hierarchy/model_writer.h"
#include "page_equality.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <span>

namespace gnomon::hierarchy {
namespace {

std::string pathFor(const std::string& name) {
    const char* test = testing::UnitTest::GetInstance()->current_test_info()->name();
    return testing::TempDir() + "gnomon_" + test + "_" + name + ".gnm";
}

tests::TinyModel coloredModel() {
    tests::TinyModelOptions options;
    options.normals = true;
    options.colors = true;
    options.origin = {1e7, -2.5, 0.125};
    return tests::makeTinyModel(options);
}

/// Opens `path` and reads all of it.
void readAll(const std::string& path) {
    const ModelFile file(path);
    for (std::uint32_t page = 0; page < file.pages().size(); ++page)
        file.readPage(page);
}

std::string bytesOf(const std::string& path) {
    return readTextFile(path);
}

TEST(ModelFile, ReadsBackWhatWasWritten) {
    tests::TinyModel model = coloredModel();
    model.summary.dropped = {{"degenerate", 3}, {"doubled", 14}};
    model.summary.options = {{"cluster-triangles", "128"}, {"simplifier", "own"}};
    const std::string path = pathFor("read_back");
    const std::string hash = tests::writeModel(model, path);
    const ModelFile file(path);
    EXPECT_EQ(file.contentHash(), hash);
    EXPECT_EQ(file.computedContentHash(), hash);
    EXPECT_EQ(file.fileBytes(), std::filesystem::file_size(path));
    ASSERT_EQ(file.pages().size(), model.pages.size());
    for (std::uint32_t page = 0; page < file.pages().size(); ++page) {
        EXPECT_TRUE(samePage(file.readPage(page), model.pages[page])) << "page " << page;
        EXPECT_EQ(file.pages()[page].level, model.pages[page].level);
        for (const std::uint32_t child : file.pages()[page].children)
            EXPECT_LT(file.pages()[child].level, file.pages()[page].level);
        EXPECT_EQ(file.pages()[page].children.empty(), file.pages()[page].level == 0);
        EXPECT_EQ(file.pages()[page].triangleCount, model.pages[page].triangles.size());
    }
    const ModelSummary& summary = file.summary();
    EXPECT_EQ(summary.grid.origin, model.summary.grid.origin);
    EXPECT_EQ(summary.grid.stepExponent, model.summary.grid.stepExponent);
    EXPECT_EQ(summary.bounds.min, model.summary.bounds.min);
    EXPECT_EQ(summary.bounds.max, model.summary.bounds.max);
    EXPECT_EQ(summary.sourceTriangles, model.summary.sourceTriangles);
    EXPECT_EQ(summary.sourceVertices, model.summary.sourceVertices);
    EXPECT_EQ(summary.coarsestTriangles, model.summary.coarsestTriangles);
    EXPECT_EQ(summary.dropped, model.summary.dropped);
    EXPECT_EQ(summary.options, model.summary.options);
    EXPECT_TRUE(summary.hasNormals && summary.hasColors);
    ASSERT_EQ(summary.levels.size(), model.summary.levels.size());
    for (std::size_t i = 0; i < summary.levels.size(); ++i) {
        EXPECT_EQ(summary.levels[i].triangles, model.summary.levels[i].triangles);
        EXPECT_EQ(summary.levels[i].clusters, model.summary.levels[i].clusters);
        EXPECT_EQ(summary.levels[i].groups, model.summary.levels[i].groups);
        EXPECT_EQ(summary.levels[i].maxError, model.summary.levels[i].maxError);
    }
}

TEST(ModelFile, TheSameModelGivesTheSameBytes) {
    tests::writeModel(coloredModel(), pathFor("once"));
    tests::writeModel(coloredModel(), pathFor("twice"));
    EXPECT_TRUE(bytesOf(pathFor("once")) == bytesOf(pathFor("twice")));
}

TEST(ModelFile, IsNotThereUntilItIsFinished) {
    const std::string path = pathFor("unfinished");
    std::filesystem::remove(path);
    const tests::TinyModel model = coloredModel();
    {
        ModelWriter writer(path);
        writer.append(encodePage(model.pages[0]));
        EXPECT_GT(writer.bytesWritten(), kHeaderBytes);
    }
    EXPECT_FALSE(std::filesystem::exists(path));
}

/// Flips bits of one byte of `good` at `offset` and expects the file to be refused with its name and a place.
void expectRefused(const std::string& good, std::size_t offset, unsigned char mask) {
    const std::string path = pathFor("mutated");
    std::string bad = good;
    bad[offset] = static_cast<char>(static_cast<unsigned char>(bad[offset]) ^ mask);
    writeTextFile(path, bad);
    try {
        readAll(path);
        ADD_FAILURE() << "byte " << offset << " of " << good.size() << " changed by " << int{mask} << " unseen";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(path + ": byte "), std::string::npos) << error.what();
    }
}

TEST(ModelFile, RefusesAChangeOfAnyHeaderTableOrFooterByte) {
    tests::TinyModelOptions options;
    options.gridExponent = 3;
    const std::string path = pathFor("tables");
    tests::writeModel(tests::makeTinyModel(options), path);
    const std::string good = bytesOf(path);
    const ModelFile file(path);
    const std::uint64_t pagesEnd = file.pages().back().offset + file.pages().back().storedBytes;
    Random random(1);
    const auto mask = [&random] { return static_cast<unsigned char>(1 + random.below(255)); };
    for (std::size_t i = 0; i < kHeaderBytes; ++i)
        expectRefused(good, i, mask());
    for (std::size_t i = pagesEnd; i < good.size(); ++i)
        expectRefused(good, i, mask());
}

TEST(ModelFile, RefusesEveryOtherFormatVersionAndSaysWhatToDo) {
    const std::string path = pathFor("version");
    tests::writeModel(coloredModel(), path);
    const std::string good = bytesOf(path);
    for (const std::uint32_t version : {0U, kOldestFormatVersion - 1, kFormatVersion + 1}) {
        std::string other = good;
        for (std::size_t i = 0; i < 4; ++i)
            other[8 + i] = static_cast<char>(version >> (8 * i));
        writeTextFile(path, other);
        try {
            readAll(path);
            ADD_FAILURE() << "version " << version << " was read";
        } catch (const Error& error) {
            EXPECT_EQ(
                std::string(error.what()),
                path +
                    ": byte 8: made by another version of gnomon; build it again from its source: expected format "
                    "version 3 to 4, found " +
                    std::to_string(version));
        }
    }
}

TEST(ModelText, TellsAxesFieldsAndErrorsOfAttributesWhereThereAreAny) {
    const std::string path = pathFor("text");
    tests::TinyModel model = coloredModel();
    tests::writeModel(model, path);
    const auto has = [&path](const char* words) { return modelText(ModelFile(path)).find(words) != std::string::npos; };
    EXPECT_TRUE(has("\naxes       up y, guess; in m\n"));
    EXPECT_TRUE(has(", normals, colours\n"));
    EXPECT_TRUE(has("groups  largest error\n"));
    model.summary.up.direction = {0, 0, 1};
    model.summary.unit = Unit::Foot;
    model.summary.fields = {{"qual\nity", -1, 2, 8}};
    model.summary.levels.back().maxAttributeError = 12.5;
    tests::writeModel(model, path);
    EXPECT_TRUE(has("\naxes       up z, guess; in ft\n"));
    EXPECT_TRUE(has("ity -1 to 2 in 8 bits\n"));
    EXPECT_FALSE(has("qual\nity"));
    EXPECT_TRUE(has("largest error  of attributes\n"));
    EXPECT_TRUE(has(" 12.5\n"));
}

TEST(ModelFile, ReadsAModelOfFormat3WithTheDefaultsOfWhatItDidNotSay) {
    const std::string path = pathFor("format3");
    const tests::TinyModel model = coloredModel();
    tests::writeModel(model, path);
    std::string bytes = bytesOf(path);
    const auto part = [&](std::size_t first, std::size_t count) {
        return std::as_bytes(std::span(bytes).subspan(first, count));
    };
    Footer footer = decodeFooter(part(bytes.size() - kFooterBytes, kFooterBytes));
    // Its summary ends with the levels, its pages and their table are the same.
    const std::size_t added = 3 * sizeof(double) + 2 + model.summary.levels.size() * sizeof(double);
    footer.summary.bytes -= added;
    footer.summary.checksum = checksum64(part(footer.summary.offset, footer.summary.bytes));
    footer.fileBytes -= added;
    bytes.resize(footer.summary.offset + footer.summary.bytes);
    const auto append = [&](const std::vector<std::byte>& more) {
        bytes.append(reinterpret_cast<const char*>(more.data()), more.size());
    };
    append(encodeFooter(footer));
    const std::vector<std::byte> header = encodeHeader(flagsOf(model.summary), {}, 3);
    std::memcpy(bytes.data(), header.data(), header.size());
    writeTextFile(path, bytes);
    const ModelFile file(path);
    EXPECT_EQ(file.formatVersion(), 3U);
    EXPECT_EQ(file.summary().up, UpAxis());
    EXPECT_EQ(file.summary().unit, Unit::Metre);
    EXPECT_TRUE(file.summary().fields.empty());
    EXPECT_EQ(file.summary().attributeError(), 0);
    ASSERT_EQ(file.pages().size(), model.pages.size());
    for (std::uint32_t page = 0; page < file.pages().size(); ++page)
        EXPECT_TRUE(samePage(file.readPage(page), model.pages[page])) << page;
}

TEST(ModelFile, RefusesAChangeInAnyPage) {
    const std::string path = pathFor("pages");
    tests::writeModel(coloredModel(), path);
    const std::string good = bytesOf(path);
    Random random(2);
    const ModelFile file(path);
    for (const PageInfo& page : file.pages())
        for (int i = 0; i < 20; ++i)
            expectRefused(
                good, page.offset + random.below(page.storedBytes), static_cast<unsigned char>(1 + random.below(255)));
}

TEST(ModelFile, ADamagedPageLeavesTheOthersReadable) {
    const std::string path = pathFor("one_damaged");
    const tests::TinyModel model = coloredModel();
    tests::writeModel(model, path);
    std::string bytes = bytesOf(path);
    ASSERT_GT(model.pages.size(), 2U);
    const std::uint64_t offset = ModelFile(path).pages()[2].offset;
    bytes[offset + 5] = static_cast<char>(bytes[offset + 5] ^ 1);
    writeTextFile(path, bytes);
    const ModelFile file(path);
    EXPECT_NE(file.computedContentHash(), file.contentHash());
    for (std::uint32_t page = 0; page < file.pages().size(); ++page) {
        if (page == 2)
            EXPECT_THROW(file.readPage(page), Error);
        else
            EXPECT_TRUE(samePage(file.readPage(page), model.pages[page]));
    }
}

TEST(ModelFile, RefusesAFileCutOffOrLengthened) {
    const std::string path = pathFor("whole");
    tests::writeModel(coloredModel(), path);
    const std::string good = bytesOf(path);
    Random random(3);
    const std::string cut = pathFor("cut");
    for (int i = 0; i < 100; ++i) {
        writeTextFile(cut, good.substr(0, i < 50 ? random.below(good.size()) : good.size() - 1 - random.below(200)));
        EXPECT_THROW(readAll(cut), Error);
    }
    writeTextFile(cut, good + "x");
    EXPECT_THROW(readAll(cut), Error);
    writeTextFile(cut, "");
    EXPECT_THROW(readAll(cut), Error);
}

} // namespace
} // namespace gnomon::hierarchy
