// Fields as numbers: half a step off at most, and what of a source cannot be one.
#include "core/random.h"
#include "preprocess/chunk/field_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon::chunk {
namespace {

/// Vertices at 0 with these fields.
class FieldSource final : public read::MeshSource {
public:
    FieldSource(std::vector<std::string> names, std::vector<double> values) : values_(std::move(values)) {
        summary_.path = "it";
        summary_.fields = std::move(names);
        summary_.vertexCount = values_.size() / summary_.fields.size();
    }

    const read::MeshSummary& summary() const override { return summary_; }

    void readVertices(const read::VertexSink& sink) override {
        const std::vector<glm::dvec3> positions(summary_.vertexCount, glm::dvec3(0));
        read::VertexBlock block;
        block.positions = positions;
        block.fields = values_;
        sink(block);
    }

    void readTriangles(const read::TriangleSink& /*sink*/) override {}

private:
    std::vector<double> values_;
    read::MeshSummary summary_;
};

VertexTable<std::uint8_t> corners(const std::vector<std::uint8_t>& counts) {
    VertexTable<std::uint8_t> table(counts.size());
    for (std::size_t v = 0; v < counts.size(); ++v)
        table.at(v) = counts[v];
    return table;
}

TEST(FieldNumbers, AreHalfAStepOffAtMost) {
    NoProgress progress;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        const std::size_t count = 1 + seed % hierarchy::kMaxFields;
        std::vector<std::string> names;
        for (std::size_t i = 0; i < count; ++i)
            names.push_back("f" + std::to_string(i));
        std::vector<double> values(50 * count);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = i % count == 1 ? 7 : random.uniform(-1, 1) * std::ldexp(1, static_cast<int>(seed) - 20);
        FieldSource source(names, values);
        const auto fields = measuredFields(source, corners(std::vector<std::uint8_t>(50, 1)), progress);
        const hierarchy::FieldLayout layout = hierarchy::FieldLayout::of(count);
        ASSERT_EQ(fields.size(), count);
        for (std::size_t v = 0; v < 50; ++v) {
            const std::span<const double> own = std::span(values).subspan(v * count, count);
            const std::uint32_t word = packedFields(own, fields);
            for (std::size_t i = 0; i < count; ++i) {
                EXPECT_EQ(fields[i].bits, layout.bits[i]);
                const double range = fields[i].max - fields[i].min;
                const double back = fields[i].min + layout.number(word, i) * range / layout.maxNumber(i);
                EXPECT_LE(std::abs(back - own[i]), fields[i].error() * (1 + 1e-9));
            }
        }
    }
}

TEST(FieldNumbers, CountOnlyVerticesThatTrianglesUse) {
    NoProgress progress;
    FieldSource source({"a"}, {5, std::numeric_limits<double>::quiet_NaN(), -3, 99});
    const auto fields = measuredFields(source, corners({1, 0, 2, 0}), progress);
    EXPECT_EQ(fields, (std::vector<hierarchy::Field>{{"a", -3, 5, 16}}));
    EXPECT_EQ(packedFields(std::array{-3.0}, fields), 0U);
    EXPECT_EQ(packedFields(std::array{5.0}, fields), 0xFFFFU);
    EXPECT_EQ(measuredFields(source, corners({0, 0, 0, 0}), progress)[0].error(), 0);
}

TEST(FieldNumbers, RefuseWhatNoNumberStandsFor) {
    NoProgress progress;
    const auto messageFor = [&](std::vector<std::string> names, std::vector<double> values) {
        FieldSource source(std::move(names), std::move(values));
        try {
            measuredFields(source, corners({1, 1}), progress);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(messageFor({"a"}, {1, kInfinite}), "it: field a of vertex 1 is not finite");
    EXPECT_EQ(
        messageFor({"a"}, {-1e308, 1e308}),
        "it: the range of field a is too large; do not store this field: expected max - min below 1.8e308, found "
        "-1e+308 "
        "to 1e+308");
    EXPECT_EQ(
        messageFor({"a", "b", "c", "d", "e"}, std::vector<double>(10)),
        "it: too many fields: expected at most 4, found 5");
}

} // namespace
} // namespace gnomon::chunk
