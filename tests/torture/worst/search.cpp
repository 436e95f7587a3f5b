#include "search.h"

#include "core/random.h"

#include <cmath>

namespace gnomon::torture {

namespace {

double scoreOf(const Objective& objective, const std::vector<double>& genes) {
    return objective.score(Genes(genes), Words::No).value;
}

/// A change of one gene or some: afresh, to an end, or by a step of any order of magnitude.
std::vector<double> mutated(std::vector<double> genes, Random& random) {
    const std::uint64_t changes = 1 + (random.below(3) == 0 ? random.below(4) : 0);
    for (std::uint64_t i = 0; i < changes; ++i) {
        double& gene = genes[random.below(genes.size())];
        const std::uint64_t kind = random.below(10);
        if (kind < 3)
            gene = random.unit();
        else if (kind == 3)
            gene = static_cast<double>(random.below(3)) / 2;
        else
            gene += random.uniform(-1, 1) * std::pow(10.0, random.uniform(-9, -0.3));
        gene = std::clamp(gene, 0.0, 1.0);
    }
    return genes;
}

std::vector<double> drawn(std::size_t count, Random& random) {
    std::vector<double> genes(count);
    for (double& gene : genes)
        gene = random.unit();
    return genes;
}

} // namespace

Found shrunk(const Objective& objective, Found found) {
    for (std::size_t i = 0; i < found.genes.size(); ++i)
        for (const double simple : {0.0, 0.5, 1.0}) {
            if (found.genes[i] == simple) break;
            Found simpler = found;
            simpler.genes[i] = simple;
            simpler.value = scoreOf(objective, simpler.genes);
            // Half of what it is above the bar has to stay, or it would turn into another, smaller find.
            if (!(simpler.value > objective.bar && simpler.value - objective.bar >= (found.value - objective.bar) / 2))
                continue;
            found = std::move(simpler);
            break;
        }
    return found;
}

SearchResult search(const Objective& objective, const SearchOptions& options) {
    Random random(options.seed);
    const std::uint64_t stepsAClimb = options.stepsAClimb != 0 ? options.stepsAClimb : 12 * objective.genes;
    SearchResult result;
    Found at;
    std::uint64_t stepOfClimb = stepsAClimb;
    for (std::uint64_t step = 0; step < options.steps; ++step) {
        if (step > 0 && options.isOver && options.isOver()) break;
        ++result.steps;
        const bool isAfresh = stepOfClimb >= stepsAClimb;
        Found next;
        next.genes = isAfresh ? drawn(objective.genes, random) : mutated(at.genes, random);
        next.value = scoreOf(objective, next.genes);
        stepOfClimb = isAfresh ? 0 : stepOfClimb + 1;
        result.climbs += isAfresh ? 1 : 0;
        if (isAfresh || next.value >= at.value) at = std::move(next);
        if (step == 0 || at.value > result.worst.value) {
            result.worst = at;
            result.stepOfWorst = step;
        }
        if (at.value > objective.bar) {
            result.finds.push_back(shrunk(objective, at));
            stepOfClimb = stepsAClimb;
        }
    }
    return result;
}

} // namespace gnomon::torture
