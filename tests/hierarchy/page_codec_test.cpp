// Pages go through their stored form unchanged, and damaged ones are refused even where the checksum was made to fit.
#include "core/random.h"
#include "hierarchy/bytes.h"
#include "hierarchy/codec/cluster_order.h"
#include "hierarchy/model_writer.h"
#include "hierarchy/page_codec.h"
#include "hierarchy/page_fields.h"
#include "hierarchy/validation.h"
#include "page_equality.h"
#include "random_page.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::hierarchy {
namespace {

Page throughBytes(const Page& page) {
    const EncodedPage encoded = encodePage(page);
    return decodePageBytes(encoded.bytes, encoded.info);
}

TEST(PageCodec, RandomPagesComeBackUnchanged) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const Page page = randomPage(seed);
        EXPECT_TRUE(samePage(throughBytes(page), page)) << "seed " << seed;
        Page ordered = page;
        orderForCoding(ordered);
        EXPECT_TRUE(samePage(throughBytes(ordered), ordered)) << "ordered, seed " << seed;
    }
}

/// Fields of 1 to 16 bits each, smooth or at random, the same at equal vertices of half the pages.
PageFields randomFields(const Page& page, std::uint64_t seed) {
    Random random(seed);
    PageFields fields;
    unsigned left = 32;
    for (std::size_t i = 0; i <= seed % kMaxFields; ++i) {
        const auto max = static_cast<unsigned>(std::min<std::size_t>(16, left - (kMaxFields - 1 - i)));
        fields.layout.bits[i] = static_cast<std::uint8_t>(1 + random.below(max));
        left -= fields.layout.bits[i];
    }
    for (const Vertex& vertex : page.vertices) {
        const std::uint64_t word = random.below(2) == 0 ? mix64(vertex.position.x) : random.bits();
        fields.words.push_back(static_cast<std::uint32_t>(word >> 32U) >> left);
    }
    return fields;
}

/// By vertex of a page, what tells it apart from others.
std::vector<std::pair<Vertex, std::uint32_t>> withFields(const Page& page, const PageFields& fields) {
    std::vector<std::pair<Vertex, std::uint32_t>> all;
    for (std::size_t v = 0; v < page.vertices.size(); ++v)
        all.emplace_back(page.vertices[v], fields.words[v]);
    std::sort(all.begin(), all.end());
    return all;
}

TEST(PageCodec, FieldsComeBackAndGoWithTheirVertices) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const Page page = randomPage(seed);
        const PageFields fields = randomFields(page, seed);
        Page ordered = page;
        PageFields orderedFields = fields;
        orderForCoding(ordered, orderedFields);
        EXPECT_TRUE(withFields(page, fields) == withFields(ordered, orderedFields)) << "seed " << seed;
        const EncodedPage encoded = encodePage(ordered, orderedFields);
        PageFields back;
        EXPECT_TRUE(samePage(decodePageBytes(encoded.bytes, encoded.info, back), ordered)) << "seed " << seed;
        EXPECT_TRUE(back == orderedFields) << "seed " << seed;
        EXPECT_TRUE(samePage(decodePageBytes(encoded.bytes, encoded.info), ordered)) << "unread, seed " << seed;
        const EncodedPage without = encodePage(ordered);
        decodePageBytes(without.bytes, without.info, back);
        EXPECT_TRUE(back == PageFields()) << "seed " << seed;
    }
}

TEST(PageCodec, DamagedFieldsNeverCrashAndNeverLeaveTheirBits) {
    std::size_t refused = 0;
    std::size_t taken = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Page page = randomPage(seed);
        const EncodedPage encoded = encodePage(page, randomFields(page, seed));
        Random random(seed);
        for (int mutation = 0; mutation < 50; ++mutation) {
            std::vector<std::byte> bytes = encoded.bytes;
            const std::size_t tail = std::min<std::size_t>(bytes.size(), 4 * page.vertices.size()); // mostly fields
            bytes[bytes.size() - 1 - random.below(tail)] ^= static_cast<std::byte>(1 + random.below(255));
            PageFields fields;
            try {
                decodePageBytes(bytes, encoded.info, fields);
                EXPECT_EQ(fields.words.size(), fields.layout.count() > 0 ? page.vertices.size() : 0);
                unsigned bits = 0;
                for (const std::uint8_t each : fields.layout.bits)
                    bits += each;
                for (const std::uint32_t word : fields.words)
                    EXPECT_EQ(std::uint64_t{word} >> bits, 0U);
                ++taken;
            } catch (const Damage&) {
                ++refused;
            }
        }
    }
    EXPECT_GT(refused, 100U);
    EXPECT_GT(taken, 100U) << "mutations never reach the fields";
}

TEST(PageCodec, ErrorsOfNothingComeBack) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Page page = randomPage(seed);
        for (Group& group : page.groups)
            group.error = 0;
        for (Refinement& refinement : page.refinements)
            refinement.error = 0;
        EXPECT_TRUE(samePage(throughBytes(page), page)) << "seed " << seed;
    }
}

TEST(PageCodec, TheSamePageGivesTheSameBytes) {
    EXPECT_TRUE(encodePage(randomPage(7)).bytes == encodePage(randomPage(7)).bytes);
}

TEST(PageCodec, BytesDoNotDependOnWhereThePagesLie) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Page page = randomPage(seed);
        Page moved = page;
        for (Refinement& refinement : moved.refinements)
            refinement.group.page = refinement.group.page * 3 + 5;
        EXPECT_TRUE(encodePage(page).bytes == encodePage(moved).bytes) << "seed " << seed;
        EXPECT_TRUE(samePage(throughBytes(moved), moved)) << "seed " << seed;
    }
}

/// All triangles of a cluster, sorted, each in the least of its three turns.
std::vector<std::array<Vertex, 3>> surface(const Page& page, const Cluster& cluster) {
    std::vector<std::array<Vertex, 3>> triangles;
    for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
        std::array<Vertex, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = page.vertices[cluster.firstVertex + page.triangles[cluster.firstTriangle + t][k]];
        std::array<Vertex, 3> min = corners;
        for (int turn = 0; turn < 2; ++turn) {
            std::rotate(corners.begin(), corners.begin() + 1, corners.end());
            min = std::min(min, corners);
        }
        triangles.push_back(min);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

TEST(ClusterOrder, KeepsTheSurfaceAndTheWinding) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Page page = randomPage(seed);
        Page ordered = page;
        orderForCoding(ordered);
        EXPECT_EQ(pageFault(ordered), std::nullopt);
        for (std::size_t c = 0; c < page.clusters.size(); ++c)
            EXPECT_TRUE(surface(ordered, ordered.clusters[c]) == surface(page, page.clusters[c])) << "seed " << seed;
    }
}

TEST(ClusterOrder, PaysInBytes) {
    tests::TinyModelOptions options;
    Page page = tests::makeTinyModel(options).pages.back();
    const std::size_t ordered = encodePage(page).bytes.size();
    Random random(3);
    for (const Cluster& cluster : page.clusters)
        for (std::uint32_t t = cluster.triangleCount - 1; t > 0; --t)
            std::swap(
                page.triangles[cluster.firstTriangle + t], page.triangles[cluster.firstTriangle + random.below(t + 1)]);
    EXPECT_LT(static_cast<double>(ordered), 0.8 * static_cast<double>(encodePage(page).bytes.size()));
}

TEST(PageCodec, DamagedBytesNeverCrashAndNeverBreakTheRules) {
    std::size_t refused = 0;
    std::size_t taken = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const EncodedPage encoded = encodePage(randomPage(seed));
        Random random(seed);
        for (int mutation = 0; mutation < 50; ++mutation) {
            std::vector<std::byte> bytes = encoded.bytes;
            const std::uint64_t flips = 1 + random.below(3);
            for (std::uint64_t i = 0; i < flips; ++i)
                bytes[random.below(bytes.size())] ^= static_cast<std::byte>(1 + random.below(255));
            if (random.below(5) == 0) bytes.resize(random.below(bytes.size()));
            try {
                // No checksum stands in the way here: what is decoded all the same must be a valid page.
                EXPECT_EQ(pageFault(decodePageBytes(bytes, encoded.info)), std::nullopt);
                ++taken;
            } catch (const Damage&) {
                ++refused;
            }
        }
    }
    EXPECT_GT(refused, 500U);
    EXPECT_GT(taken, 10U) << "mutations never reach past the first checks";
}

TEST(PageCodec, CountsThatLieAreRefused) {
    const EncodedPage encoded = encodePage(randomPage(5));
    for (std::uint32_t PageInfo::*count :
         {&PageInfo::groupCount,
          &PageInfo::clusterCount,
          &PageInfo::refinementCount,
          &PageInfo::vertexCount,
          &PageInfo::triangleCount})
        for (const std::uint32_t lie : {0U, 1U, 1000U, 0xFFFFFFFFU}) {
            PageInfo info = encoded.info;
            if (info.*count == lie) continue;
            info.*count = lie;
            EXPECT_THROW(decodePageBytes(encoded.bytes, info), Damage);
        }
}

TEST(Validation, NamesEachBrokenRule) {
    const auto fault = [](auto&& breakIt) {
        Page page = randomPage(11);
        breakIt(page);
        return pageFault(page).value_or("");
    };
    EXPECT_EQ(fault([](Page&) {}), "");
    EXPECT_NE(fault([](Page& p) { p.groups.clear(); }), "");
    EXPECT_NE(fault([](Page& p) { p.clusters[0].firstVertex = 1; }), "");
    EXPECT_NE(fault([](Page& p) { p.clusters.back().triangleCount -= 1; }), "");
    EXPECT_NE(fault([](Page& p) { p.clusters[0].box.min.x += 1; }), "");
    EXPECT_NE(fault([](Page& p) { p.groups[0].box.max.x += 1; }), "");
    EXPECT_NE(fault([](Page& p) { p.groups[0].error = std::nan(""); }), "");
    EXPECT_NE(fault([](Page& p) { p.groups[0].bounds.radius = -1; }), "");
    EXPECT_NE(fault([](Page& p) { p.clusters[0].refinement = 77; }), "");
    EXPECT_NE(fault([](Page& p) { p.groups[0].clusterCount = 0xFFFFFFFFU; }), "");
    EXPECT_NE(fault([](Page& p) { p.vertices[0].position.x = 0xFFFFFFFFU; }), "");
}

TEST(Validation, SpheresEnclose) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const std::array spheres{randomSphere(random), randomSphere(random), randomSphere(random)};
        const Sphere around = enclosingSphere(spheres);
        for (const Sphere& sphere : spheres)
            EXPECT_TRUE(encloses(around, sphere));
        EXPECT_FALSE(encloses({around.center, around.radius * 0.99}, around));
    }
    EXPECT_TRUE(encloses(Sphere{{0, 0, 0}, 1.733}, Box{glm::dvec3(-1), glm::dvec3(1)}));
    EXPECT_FALSE(encloses(Sphere{{0, 0, 0}, 1.731}, Box{glm::dvec3(-1), glm::dvec3(1)}));
    EXPECT_TRUE(encloses(Sphere{{0, 0, 0}, 0}, Sphere{{0, 0, 0}, 0})) << "a point encloses itself";
}

} // namespace
} // namespace gnomon::hierarchy
