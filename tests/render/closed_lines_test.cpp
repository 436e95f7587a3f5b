// The lines in which a plane meets a model, which of them are closed: against all choices of what to leave out, and
// parts that are known to be closed beside open ones that touch them.
#include "core/random.h"
#include "render/view/closed_lines.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace gnomon::render {
namespace {

constexpr std::size_t kNowhere = 1000;

std::int64_t lineLength(const glm::dvec3& a, const glm::dvec3& b) {
    return 1 + std::llround(glm::length(b - a));
}

/// The least length of lines to be left out of `lines`, or added between ends at most `bridge` apart, by which each
/// point is left as often as reached: of all choices. Ends are at one point where they agree.
class MinOpeningByTrial {
public:
    MinOpeningByTrial(const std::vector<SectionLine>& lines, double bridge) : lines_(lines), bridge_(bridge) {
        for (const SectionLine& line : lines) {
            ++surplus_[keyOf(line.from)];
            --surplus_[keyOf(line.to)];
        }
        initial_ = surplus_;
    }

    std::int64_t length() { return minFrom(0); }

private:
    using Key = std::array<double, 3>;

    static Key keyOf(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

    static glm::dvec3 pointOf(const Key& key) { return {key[0], key[1], key[2]}; }

    std::int64_t minFrom(std::size_t line) {
        if (line == lines_.size()) return minOfBridges();
        const std::int64_t kept = minFrom(line + 1);
        --surplus_[keyOf(lines_[line].from)];
        ++surplus_[keyOf(lines_[line].to)];
        const std::int64_t left = minFrom(line + 1) + lineLength(lines_[line].from, lines_[line].to);
        ++surplus_[keyOf(lines_[line].from)];
        --surplus_[keyOf(lines_[line].to)];
        return std::min(kept, left);
    }

    std::int64_t minOfBridges() {
        const auto start = std::find_if(surplus_.begin(), surplus_.end(), [](const auto& s) { return s.second > 0; });
        if (start == surplus_.end()) return 0;
        if (initial_[start->first] <= 0) return kImpossible;
        std::int64_t min = kImpossible;
        --start->second;
        for (auto& [key, surplus] : surplus_) {
            const double apart = glm::length(pointOf(key) - pointOf(start->first));
            if (surplus >= 0 || initial_[key] >= 0 || apart > bridge_) continue;
            ++surplus;
            min = std::min(min, minOfBridges() + lineLength(pointOf(key), pointOf(start->first)));
            --surplus;
        }
        ++start->second;
        return min;
    }

    static constexpr std::int64_t kImpossible = 1'000'000'000;
    const std::vector<SectionLine>& lines_;
    double bridge_;
    std::map<Key, int> surplus_, initial_;
};

TEST(SectionLines, LeaveOutTheLeastLengthOfLinesThatAreNotClosed) {
    Random random(11);
    int opened = 0;
    int bridged = 0;
    for (int trial = 0; trial < 6000; ++trial) {
        std::vector<glm::dvec3> points;
        for (int i = 0; i < 4; ++i) {
            points.emplace_back(400.0 * i, random.uniform(0, 900), random.uniform(0, 900));
            if (random.below(3) == 0) points.push_back(points.back() + glm::dvec3(random.uniform(3, 7), 0, 0));
        }
        std::vector<SectionLine> lines;
        const std::uint64_t count = 4 + random.below(8);
        for (std::uint64_t i = 0; i < count; ++i) {
            const glm::dvec3 from = points[random.below(points.size())];
            const glm::dvec3 to = points[random.below(points.size())];
            if (glm::length(to - from) > 10) lines.push_back({from, to});
        }
        std::vector<SectionLine> marked = lines;
        markClosed(marked);
        std::int64_t changed = 0;
        std::vector<SectionLine> closed;
        for (std::size_t i = 0; i < marked.size(); ++i) {
            if (marked[i].isClosed) closed.push_back(marked[i]);
            const bool isAdded = i >= lines.size();
            opened += static_cast<int>(!marked[i].isClosed);
            bridged += static_cast<int>(isAdded);
            if (isAdded || !marked[i].isClosed) changed += lineLength(marked[i].from, marked[i].to);
        }
        EXPECT_EQ(changed, MinOpeningByTrial(lines, 8).length()) << trial;
        EXPECT_EQ(MinOpeningByTrial(closed, 0).length(), 0) << trial;
    }
    EXPECT_GT(opened, 6000);
    EXPECT_GT(bridged, 600);
}

glm::dvec3 besidePoint(const glm::dvec3& p, Random& random) {
    return p + glm::dvec3(random.uniform(-0.9, 0.9), 0, random.uniform(-0.9, 0.9));
}

/// Appends the lines around a convex polygon, that numbered `without` left out; ends agree, or within a weld.
std::vector<glm::dvec3> addPolygon(
    const glm::dvec3& center, std::size_t without, bool isExact, Random& random, std::vector<SectionLine>& lines) {
    const std::size_t count = 4 + random.below(5);
    std::vector<glm::dvec3> corners;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(count);
        corners.push_back(center + 900.0 * glm::dvec3(std::cos(angle), 0, std::sin(angle)));
    }
    for (std::size_t i = 0; i < count; ++i)
        if (i != without)
            lines.push_back({isExact ? corners[i] : besidePoint(corners[i], random), corners[(i + 1) % count]});
    return corners;
}

/// Whether closed lines leave each point as often as they reach it, to the bit: a row of pixels leaks through less.
bool isTight(const std::vector<SectionLine>& lines) {
    std::map<std::array<double, 3>, int> surplus;
    for (const SectionLine& line : lines) {
        if (!line.isClosed) continue;
        ++surplus[{line.from.x, line.from.y, line.from.z}];
        --surplus[{line.to.x, line.to.y, line.to.z}];
    }
    return std::all_of(surplus.begin(), surplus.end(), [](const auto& at) { return at.second == 0; });
}

TEST(SectionLines, KeepClosedPartsClosedWhateverOpenOnesTouchThem) {
    Random random(12);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<SectionLine> lines;
        const bool isExact = trial % 2 == 0;
        const std::vector<glm::dvec3> corners = addPolygon({0, 0, 0}, kNowhere, isExact, random, lines);
        const std::size_t closed = lines.size();
        const auto cornerBeside = [&] { return besidePoint(corners[random.below(corners.size())], random); };
        // A sheet away from a corner, one from corner to corner, and a part of which a side is missing.
        const glm::dvec3 away(3000, 0, random.uniform(-900, 900));
        lines.push_back(random.below(2) == 0 ? SectionLine{cornerBeside(), away} : SectionLine{away, cornerBeside()});
        const std::size_t chord = random.below(corners.size());
        const glm::dvec3 from = isExact ? besidePoint(corners[chord], random) : corners[chord];
        lines.push_back({from, besidePoint(corners[(chord + 2) % corners.size()], random)});
        addPolygon({9000, 0, 0}, 1 + random.below(3), trial % 3 == 0, random, lines);
        if (isExact) { // what is closed by itself stays so beside a longer way around as well
            lines.push_back({besidePoint(corners[0], random), {0, 0, -7000}});
            lines.push_back({{0, 0, -7000}, besidePoint(corners[1], random)});
        }
        std::vector<SectionLine> marked = lines;
        markClosed(marked);
        ASSERT_EQ(marked.size(), lines.size()) << trial;
        for (std::size_t i = 0; i < marked.size(); ++i)
            EXPECT_EQ(marked[i].isClosed, i < closed) << trial << " " << i;
        EXPECT_TRUE(isTight(marked)) << trial;
    }
}

TEST(SectionLines, CloseTwoPartsOfWhichOneOfTwoEqualFacesIsKept) {
    Random random(13);
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<SectionLine> lines;
        const std::vector<glm::dvec3> first = addPolygon({0, 0, 0}, kNowhere, trial % 2 == 0, random, lines);
        // The other part lies beyond the line from corner 0 to 1, of which it has none.
        const glm::dvec3 out = glm::normalize(first[0] + first[1]) * random.uniform(1200, 4000);
        const glm::dvec3 a = first[0];
        const glm::dvec3 b = first[1];
        lines.push_back({a, a + out});
        lines.push_back({a + out, b + out});
        lines.push_back({b + out, b});
        markClosed(lines);
        for (std::size_t i = 0; i < lines.size(); ++i)
            EXPECT_EQ(lines[i].isClosed, i != 0) << trial << " " << i;
        EXPECT_TRUE(isTight(lines)) << trial;
    }
}

} // namespace
} // namespace gnomon::render
