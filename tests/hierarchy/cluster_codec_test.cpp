// What decodes clusters fast beside what decodes them plainly: the same page, or both refuse, on every instruction set.
#include "hierarchy/codec/cluster_codec.h"
#include "hierarchy/codec/cluster_order.h"
#include "page_equality.h"
#include "plain_codec.h"
#include "random_page.h"
#include "tests/support/each_target.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

namespace gnomon::hierarchy {
namespace {

using Decode = void (*)(ByteReader& in, Page& page);

/// What `decode` makes of `bytes` if `like` tells the clusters' ranges; nothing if it refuses them.
std::optional<Page> decoded(Decode decode, const Page& like, std::span<const std::byte> bytes) {
    Page page = like;
    page.vertices.clear();
    page.triangles.clear();
    for (Cluster& cluster : page.clusters)
        cluster.box = {};
    try {
        ByteReader in(bytes);
        decode(in, page);
        in.expectEnd();
    } catch (const Damage&) {
        return std::nullopt;
    }
    return page;
}

/// What `decodeClusters` makes of `bytes` if it is the same on every instruction set that this machine has and plainly.
std::optional<Page> decodedAlike(const Page& like, std::span<const std::byte> bytes) {
    std::optional<Page> plain = decoded(plainlyDecodeClusters, like, bytes);
    tests::onEachTarget([&](const char* name) {
        const std::optional<Page> fast =
            decoded([](ByteReader& in, Page& page) { decodeClusters(in, page); }, like, bytes);
        EXPECT_EQ(fast.has_value(), plain.has_value()) << name;
        if (fast && plain) {
            EXPECT_TRUE(samePage(*fast, *plain)) << name;
        }
    });
    return plain;
}

std::vector<std::byte> encoded(const Page& page) {
    ByteWriter out;
    encodeClusters(page, out);
    return out.take();
}

/// The triangles of a cluster as `orderForCoding` has them: across the newest of the last 15 open edges that leads to a
/// triangle, to the first one there; if none does, the first that is left.
std::vector<Triangle> plainlyOrdered(std::vector<Triangle> left) {
    std::vector<Triangle> order;
    std::vector<std::array<std::uint8_t, 2>> open; // the newest last
    const auto enter = [&] {
        for (std::size_t age = 0; age < std::min<std::size_t>(open.size(), 15); ++age) {
            const auto [from, to] = open[open.size() - 1 - age];
            for (auto t = left.begin(); t != left.end(); ++t)
                for (std::size_t k = 0; k < 3; ++k) {
                    const Triangle turned{(*t)[k], (*t)[(k + 1) % 3], (*t)[(k + 2) % 3]};
                    if (turned[0] != from || turned[1] != to) continue;
                    left.erase(t);
                    order.push_back(turned);
                    return true;
                }
        }
        return false;
    };
    while (!left.empty()) {
        const bool isEntered = enter();
        if (!isEntered) {
            order.push_back(left.front());
            left.erase(left.begin());
        }
        const auto [a, b, c] = order.back();
        if (!isEntered) open.push_back({b, a});
        open.push_back({a, c});
        open.push_back({c, b});
    }
    return order;
}

/// With vertices numbered by first use.
std::vector<Triangle> renumbered(std::vector<Triangle> triangles) {
    std::vector<int> number(256, -1);
    int next = 0;
    for (Triangle& t : triangles)
        for (std::uint8_t& corner : t) {
            if (number[corner] < 0) number[corner] = next++;
            corner = static_cast<std::uint8_t>(number[corner]);
        }
    return triangles;
}

TEST(ClusterOrder, IsAsPlainly) {
    std::vector<Page> pages = gnomon::tests::makeTinyModel({}).pages;
    for (std::uint64_t seed = 0; seed < 200; ++seed)
        pages.push_back(randomPage(seed));
    for (const Page& page : pages) {
        Page ordered = page;
        orderForCoding(ordered);
        for (const Cluster& cluster : page.clusters) {
            const auto first = static_cast<std::ptrdiff_t>(cluster.firstTriangle);
            const auto last = first + static_cast<std::ptrdiff_t>(cluster.triangleCount);
            const std::vector<Triangle> before(page.triangles.begin() + first, page.triangles.begin() + last);
            const std::vector<Triangle> after(ordered.triangles.begin() + first, ordered.triangles.begin() + last);
            ASSERT_EQ(after, renumbered(plainlyOrdered(before)));
        }
    }
}

TEST(ClusterCodec, DecodesAsPlainlyOnEveryInstructionSet) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Page page = randomPage(seed);
        if (seed % 2 == 0) orderForCoding(page);
        const std::optional<Page> back = decodedAlike(page, encoded(page));
        ASSERT_TRUE(back.has_value());
        EXPECT_TRUE(samePage(*back, page));
    }
    for (const Page& page : gnomon::tests::makeTinyModel({}).pages) {
        const std::optional<Page> back = decodedAlike(page, encoded(page));
        ASSERT_TRUE(back.has_value());
        EXPECT_TRUE(samePage(*back, page));
    }
}

/// Anywhere, or among the first triangles of a cluster, which can name edges and vertices that are not there yet.
std::size_t placeToDamage(const Page& page, std::size_t size, Random& random) {
    if (random.below(2) == 0) return random.below(size);
    const Cluster& cluster = page.clusters[random.below(page.clusters.size())];
    return cluster.firstTriangle + random.below(std::min<std::size_t>(8, cluster.triangleCount));
}

TEST(ClusterCodec, RefusesWhatIsPlainlyRefused) {
    const gnomon::tests::TinyModel model = gnomon::tests::makeTinyModel({});
    std::size_t refused = 0;
    std::size_t taken = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Page page = seed % 2 == 0 ? randomPage(seed / 50) : model.pages[random.below(model.pages.size())];
        if (seed % 4 == 0) orderForCoding(page);
        std::vector<std::byte> bytes = encoded(page);
        const std::uint64_t flips = 1 + random.below(3);
        for (std::uint64_t i = 0; i < flips; ++i)
            bytes[placeToDamage(page, bytes.size(), random)] ^= static_cast<std::byte>(1 + random.below(255));
        if (random.below(9) == 0) bytes.resize(random.below(bytes.size()));
        ++(decodedAlike(page, bytes) ? taken : refused);
    }
    EXPECT_GT(refused, 500U);
    EXPECT_GT(taken, 100U);
}

} // namespace
} // namespace gnomon::hierarchy
