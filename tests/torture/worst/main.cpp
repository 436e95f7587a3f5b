// A machine that looks for the worst: climbs towards cases that break what is promised, and prints each as one that can
// be run again.
// usage: worst_search [OBJECTIVE] [--steps N] [--seconds S] [--seed S] [--replay GENE,GENE,...]
//        All objectives unless one is named. N steps each, of slow ones fewer. --seconds: seeds from S on until the
//        time is over. Exit 1 where something broke.
#include "search.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>

namespace gnomon::torture {
namespace {

struct Asked {
    std::string objective;
    std::string replay;
    SearchOptions search;
    double seconds = 0;
};

std::string genesText(const std::vector<double>& genes) {
    std::string text;
    for (const double gene : genes) {
        char number[32];
        static_cast<void>(std::snprintf(number, sizeof number, "%s%.17g", text.empty() ? "" : ",", gene));
        text += number;
    }
    return text;
}

std::vector<double> genesFrom(const std::string& text) {
    std::vector<double> genes;
    for (std::size_t at = 0; at < text.size(); at = std::min(text.size(), text.find(',', at)) + 1)
        genes.push_back(std::strtod(text.c_str() + at, nullptr));
    return genes;
}

void print(const Objective& objective, const Found& found) {
    const Score score = objective.score(Genes(found.genes), Words::Yes);
    std::printf("  %.9g: %s\n  --replay %s\n", found.value, score.where.c_str(), genesText(found.genes).c_str());
}

/// Whether something was found.
bool searchOnce(const Objective& objective, const SearchOptions& options) {
    const SearchResult result = search(objective, options);
    std::printf(
        "%s, seed %llu: %llu steps in %llu climbs, worst %.9g (%s; a find is above %g), %zu finds\n",
        objective.name,
        static_cast<unsigned long long>(options.seed),
        static_cast<unsigned long long>(options.steps),
        static_cast<unsigned long long>(result.climbs),
        result.worst.value,
        objective.meaning,
        objective.bar,
        result.finds.size());
    for (const Found& found : result.finds)
        print(objective, found);
    static_cast<void>(std::fflush(stdout));
    return !result.finds.empty();
}

Asked askedBy(int count, char** words) {
    Asked asked;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const bool isOption = word.rfind("--", 0) == 0;
        if (!isOption) {
            asked.objective = word;
            continue;
        }
        const char* value = ++i < count ? words[i] : "";
        if (word == "--steps") asked.search.steps = std::strtoull(value, nullptr, 10);
        if (word == "--seed") asked.search.seed = std::strtoull(value, nullptr, 10);
        if (word == "--seconds") asked.seconds = std::strtod(value, nullptr);
        if (word == "--replay") asked.replay = value;
    }
    return asked;
}

int run(const Asked& asked) {
    std::vector<Objective> objectives = viewObjectives();
    for (const Objective& objective : meshObjectives())
        objectives.push_back(objective);
    std::erase_if(
        objectives, [&](const Objective& one) { return !asked.objective.empty() && asked.objective != one.name; });
    if (objectives.empty()) {
        static_cast<void>(std::fprintf(stderr, "worst_search: there is no objective %s\n", asked.objective.c_str()));
        return 2;
    }
    bool isBroken = false;
    const auto begin = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    SearchOptions options = asked.search;
    do {
        for (const Objective& objective : objectives) {
            if (asked.replay.empty()) {
                SearchOptions own = options;
                own.steps = std::max<std::uint64_t>(options.steps / objective.slowness, 1);
                isBroken |= searchOnce(objective, own);
                continue;
            }
            const std::vector<double> genes = genesFrom(asked.replay);
            const double value = objective.score(Genes(genes), Words::No).value;
            print(objective, {genes, value});
            isBroken |= value > objective.bar;
        }
        ++options.seed;
    } while (seconds() < asked.seconds);
    return isBroken ? 1 : 0;
}

} // namespace
} // namespace gnomon::torture

int main(int count, char** words) {
    try {
        return gnomon::torture::run(gnomon::torture::askedBy(count, words));
    } catch (const std::exception& error) {
        static_cast<void>(std::fprintf(stderr, "worst_search: %s\n", error.what()));
        return 2;
    }
}
