// Fits the trees of src/hierarchy/up_trees.h to meshes of known axes and writes that file to stdout:
//   fit_trees NUMBERS > up_trees.h
// NUMBERS has a line per mesh and direction: the mesh's name, its weight, the direction that is up (0 to 5 for +x, -x,
// +y, -y, +z, -z; -1 for a mesh that has none), the direction of the line, and its numbers, as hierarchy::upNumbers
// returns them. The method is gradient boosting (Friedman 2001) of the logarithms of the odds of the six directions.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

constexpr int kTrees = 320;
constexpr std::size_t kInner = 7;
constexpr double kRate = 0.1;
constexpr double kRegularization = 1;
constexpr std::size_t kMinRows = 12;
constexpr double kMinGap = 2e-3; // between two numbers that a limit separates
constexpr double kMeshShare = 0.6;
constexpr double kNumberShare = 0.35;

struct Mesh {
    double weight = 1;
    int up = -1;
    std::array<std::vector<float>, 6> numbers;
    std::array<double, 6> scores{};
};

struct Row {
    const std::vector<float>* numbers;
    double gradient;
    double curvature;
};

struct Tree {
    std::array<int, kInner> features{};
    std::array<double, kInner> limits{};
    std::array<double, kInner + 1> votes{};

    double operator()(const std::vector<float>& numbers) const {
        std::size_t node = 0;
        while (node < kInner)
            node = 2 * node + (numbers[static_cast<std::size_t>(features[node])] < limits[node] ? 1 : 2);
        return votes[node - kInner];
    }
};

double gainOf(double gradient, double curvature) {
    return gradient * gradient / (curvature + kRegularization);
}

/// Fits the subtree at `node`; where nothing is gained all rows go to the right.
void fit(Tree& tree, std::size_t node, const std::vector<Row>& rows, const std::vector<bool>& isUsed) {
    double gradient = 0;
    double curvature = 0;
    for (const Row& row : rows) {
        gradient += row.gradient;
        curvature += row.curvature;
    }
    if (node >= kInner) {
        tree.votes[node - kInner] = kRate * gradient / (curvature + kRegularization);
        return;
    }
    tree.limits[node] = -1e30;
    double best = gainOf(gradient, curvature) + 1e-6;
    std::vector<std::pair<float, const Row*>> sorted(rows.size());
    for (std::size_t feature = 0; feature < isUsed.size(); ++feature) {
        if (!isUsed[feature]) continue;
        for (std::size_t i = 0; i < rows.size(); ++i)
            sorted[i] = {(*rows[i].numbers)[feature], &rows[i]};
        std::sort(sorted.begin(), sorted.end(), [](auto& a, auto& b) { return a.first < b.first; });
        double g = 0;
        double h = 0;
        for (std::size_t i = 0; i + kMinRows < sorted.size(); ++i) {
            g += sorted[i].second->gradient;
            h += sorted[i].second->curvature;
            if (i + 1 < kMinRows || sorted[i + 1].first - sorted[i].first < kMinGap) continue;
            const double gain = gainOf(g, h) + gainOf(gradient - g, curvature - h);
            if (gain <= best) continue;
            best = gain;
            tree.features[node] = static_cast<int>(feature);
            tree.limits[node] = (sorted[i].first + sorted[i + 1].first) / 2;
        }
    }
    std::array<std::vector<Row>, 2> sides;
    for (const Row& row : rows) {
        const bool isBelow = (*row.numbers)[static_cast<std::size_t>(tree.features[node])] < tree.limits[node];
        sides[isBelow ? 0 : 1].push_back(row);
    }
    fit(tree, 2 * node + 1, sides[0].empty() ? rows : sides[0], isUsed);
    fit(tree, 2 * node + 2, sides[1], isUsed);
}

std::vector<Row> rowsOf(std::vector<Mesh>& meshes, std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Row> rows;
    for (Mesh& mesh : meshes) {
        if (unit(random) >= kMeshShare) continue;
        const double largest = *std::max_element(mesh.scores.begin(), mesh.scores.end());
        std::array<double, 6> odds{};
        double sum = 0;
        for (std::size_t d = 0; d < 6; ++d)
            sum += odds[d] = std::exp(mesh.scores[d] - largest);
        for (std::size_t d = 0; d < 6; ++d) {
            const double chance = odds[d] / sum;
            const double wanted = mesh.up < 0 ? 1.0 / 6 : mesh.up == static_cast<int>(d) ? 1 : 0;
            rows.push_back(
                {&mesh.numbers[d],
                 mesh.weight * (wanted - chance),
                 mesh.weight * std::max(chance * (1 - chance), 1e-4)});
        }
    }
    return rows;
}

std::vector<Mesh> readMeshes(const char* path) {
    std::map<std::string, Mesh> meshes;
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string name;
        Mesh mesh;
        std::size_t direction = 0;
        words >> name >> mesh.weight >> mesh.up >> direction;
        Mesh& found = meshes.try_emplace(name, mesh).first->second;
        for (std::string word; words >> word;)
            found.numbers.at(direction).push_back(std::strtof(word.c_str(), nullptr));
    }
    std::vector<Mesh> list;
    for (auto& [name, mesh] : meshes)
        list.push_back(std::move(mesh));
    return list;
}

void print(const Tree& tree) {
    const auto list = [](const auto& values, const auto& print) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            std::printf("%s", i == 0 ? "{" : ",");
            print(values[i]);
        }
        std::printf("}");
    };
    std::printf("{");
    list(tree.features, [](int feature) { std::printf("%d", feature); });
    std::printf(",");
    list(tree.limits, [](double limit) { std::printf("%#.4gF", limit); });
    std::printf(",");
    list(tree.votes, [](double votes) { std::printf("%ld", std::lround(1000 * votes)); });
    std::printf("},\n");
}

constexpr const char* kHead =
    R"(// Decision trees that vote for the up direction of a model, given its features (up_features.h). This file is generated
// by tests/orientation/fit_trees.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gnomon::hierarchy {

/// A decision tree of depth three. At node n, a number below the limit leads to node 2n + 1, any other number to node
/// 2n + 2. The leaves contain votes: the logarithm of the odds, in thousandths.
struct UpTree {
    std::array<std::uint8_t, 7> features;
    std::array<float, 7> limits;
    std::array<std::int16_t, 8> votes;
};

// clang-format off
inline constexpr std::array<UpTree, %d> kUpTrees = {{
)";

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    std::vector<Mesh> meshes = readMeshes(argv[1]);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::printf(kHead, kTrees);
    for (int i = 0; i < kTrees; ++i) {
        std::vector<bool> isUsed(meshes.front().numbers[0].size());
        for (std::size_t feature = 0; feature < isUsed.size(); ++feature)
            isUsed[feature] = unit(random) < kNumberShare;
        Tree tree;
        fit(tree, 0, rowsOf(meshes, random), isUsed);
        for (Mesh& mesh : meshes)
            for (std::size_t d = 0; d < 6; ++d)
                mesh.scores[d] += tree(mesh.numbers[d]);
        print(tree);
    }
    std::printf("}};\n// clang-format on\n\n} // namespace gnomon::hierarchy\n");
    return 0;
}
