// Scalar properties of vertices that are read by name, in any layout, and what is refused.
#include "collect.h"
#include "core/random.h"
#include "preprocess/read/open_mesh_sources.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include <unistd.h>

namespace gnomon::read {
namespace {

std::string scratchFields(const std::string& name) {
    return testing::TempDir() + "gnomon_fields_" + std::to_string(::getpid()) + "_" + name;
}

/// What of each row a reader may be asked for; `label` is an integer of two bytes.
struct FieldRow {
    float quality = 0;
    double time = 0;
    std::int16_t label = 0;
};

std::vector<FieldRow> randomRows(std::uint64_t seed, std::size_t count) {
    Random random(seed);
    std::vector<FieldRow> rows(count);
    for (FieldRow& row : rows) {
        row.quality = static_cast<float>(random.uniform(-5, 5));
        row.time = random.uniform(1e9, 1e9 + 1);
        row.label = static_cast<std::int16_t>(random.below(1000));
    }
    return rows;
}

enum class Form { Ascii, Binary, Swapped, WithList };

template <class T>
void putField(std::string& text, T value, bool isSwapped = false) {
    std::array<char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (isSwapped) std::reverse(bytes.begin(), bytes.end());
    text.append(bytes.data(), bytes.size());
}

std::string plyOf(const std::vector<FieldRow>& rows, Form form, bool hasFaceColor = false) {
    const std::string format = form == Form::Ascii     ? "ascii"
                               : form == Form::Swapped ? "binary_big_endian"
                                                       : "binary_little_endian";
    const bool isSwapped = form == Form::Swapped;
    std::string text = "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(rows.size()) +
                       "\nproperty float x\nproperty float quality\nproperty float y\nproperty double time\n" +
                       (form == Form::WithList ? "property list uchar int more\n" : "") +
                       "property float z\nproperty short label\nelement face 1\nproperty list uchar int "
                       "vertex_indices\n" +
                       (hasFaceColor ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "") +
                       "end_header\n";
    std::ostringstream ascii;
    ascii.precision(17);
    for (std::size_t v = 0; v < rows.size(); ++v) {
        const auto x = static_cast<float>(v);
        ascii << x << ' ' << rows[v].quality << " 7 " << rows[v].time << " 9 " << rows[v].label << '\n';
        if (form == Form::Ascii) continue;
        putField(text, x, isSwapped);
        putField(text, rows[v].quality, isSwapped);
        putField(text, 7.0F, isSwapped);
        putField(text, rows[v].time, isSwapped);
        if (form == Form::WithList) putField(text, std::uint8_t{0});
        putField(text, 9.0F, isSwapped);
        putField(text, rows[v].label, isSwapped);
    }
    if (form == Form::Ascii) return text + ascii.str() + "3 0 1 2" + (hasFaceColor ? " 1 2 3\n" : "\n");
    putField(text, std::uint8_t{3});
    for (const std::int32_t corner : {0, 1, 2})
        putField(text, corner, isSwapped);
    return text + (hasFaceColor ? "\x01\x02\x03" : "");
}

std::vector<double> fieldsOf(MeshSource& source) {
    std::vector<double> values;
    source.readVertices([&](const VertexBlock& block) {
        EXPECT_EQ(block.fields.size(), block.positions.size() * source.summary().fields.size());
        values.insert(values.end(), block.fields.begin(), block.fields.end());
    });
    return values;
}

std::unique_ptr<MeshSource> openedFields(const std::string& text, const std::vector<std::string>& fields) {
    writeScratch(scratchFields("one.ply"), text);
    return openMeshSources({scratchFields("one.ply")}, gibibytes(1), fields);
}

TEST(Fields, AreReadByNameInTheOrderAskedForWhateverTheLayout) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const std::vector<FieldRow> rows =
            randomRows(seed, seed % 3 == 0 ? 40000 : 20); // several blocks, or part of one
        const auto source = openedFields(plyOf(rows, static_cast<Form>(seed % 4)), {"label", "quality", "time"});
        EXPECT_EQ(source->summary().fields, (std::vector<std::string>{"label", "quality", "time"}));
        const std::vector<double> values = fieldsOf(*source);
        ASSERT_EQ(values.size(), 3 * rows.size());
        for (std::size_t v = 0; v < rows.size(); ++v) {
            EXPECT_EQ(values[3 * v], rows[v].label);
            EXPECT_EQ(values[3 * v + 1], double{rows[v].quality});
            EXPECT_EQ(values[3 * v + 2], rows[v].time);
        }
    }
}

TEST(Fields, AreNotAmongWhatIsDropped) {
    const std::string text = plyOf(randomRows(1, 3), Form::Ascii);
    using Counts = std::map<std::string, std::uint64_t>;
    EXPECT_EQ(
        openedFields(text, {})->summary().attributesDropped,
        (Counts{{"vertex label", 3}, {"vertex quality", 3}, {"vertex time", 3}}));
    EXPECT_EQ(
        openedFields(text, {"time"})->summary().attributesDropped,
        (Counts{{"vertex label", 3}, {"vertex quality", 3}}));
}

TEST(Fields, GoWithVerticesThatFacesOfSeveralColoursSplit) {
    const std::vector<FieldRow> rows = randomRows(3, 5); // two of no face are left out
    const std::vector<double> values = fieldsOf(*openedFields(plyOf(rows, Form::Binary, true), {"time"}));
    EXPECT_EQ(values, (std::vector<double>{rows[0].time, rows[1].time, rows[2].time}));
}

TEST(Fields, OfSeveralInputsFollowOneAnother) {
    const std::vector<FieldRow> a = randomRows(4, 3);
    const std::vector<FieldRow> b = randomRows(5, 4);
    writeScratch(scratchFields("a.ply"), plyOf(a, Form::Ascii));
    writeScratch(scratchFields("b.ply"), plyOf(b, Form::Swapped));
    const auto source = openMeshSources({scratchFields("a.ply"), scratchFields("b.ply")}, gibibytes(1), {"label"});
    std::vector<double> labels;
    for (const std::vector<FieldRow>& rows : {a, b})
        for (const FieldRow& row : rows)
            labels.push_back(row.label);
    EXPECT_EQ(fieldsOf(*source), labels);
}

TEST(Fields, ThatAreNotThereAreRefusedWithAListOfThoseThatAre) {
    const auto messageFor = [](const std::vector<std::string>& fields) {
        return errorAbout(
            scratchFields("one.ply"), [&] { openedFields(plyOf(randomRows(1, 3), Form::WithList), fields); });
    };
    const std::string list = ": unknown field: expected one of quality, time, label, found ";
    EXPECT_EQ(messageFor({"intensity"}), list + "intensity");
    EXPECT_EQ(messageFor({"quality", ""}), list);
    EXPECT_EQ(messageFor({"x"}), list + "x") << "kept anyway";
    EXPECT_EQ(messageFor({"more"}), list + "more") << "a list";
    EXPECT_EQ(messageFor({"time", "time"}), ": a field is requested twice: expected each once, found time");
    writeScratch(scratchFields("two.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(
        errorAbout(
            scratchFields("two.obj"), [] { openMeshSources({scratchFields("two.obj")}, gibibytes(1), {"quality"}); }),
        ": only a PLY can have fields: expected none, found quality");
}

} // namespace
} // namespace gnomon::read
