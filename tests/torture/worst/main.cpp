// A machine that looks for the worst: climbs towards cases that break what is promised, and prints each as one that can
// be run again.
// usage: worst_search [OBJECTIVE] [--steps N] [--seconds S] [--seed S] [--replay GENE,GENE,...]
//        All objectives unless one is named. N steps each, of slow ones fewer. --seconds: seeds from S on until the
//        time is over, of which no objective takes more than its share. Exit 1 where something broke.
#include "search.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <span>
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
    const std::clock_t begin = std::clock();
    const SearchResult result = search(objective, options);
    std::printf(
        "%s, seed %llu: %llu steps in %llu climbs and %.1f s of a processor, worst %.9g (%s; a find is above %g), %zu "
        "finds\n",
        objective.name,
        static_cast<unsigned long long>(options.seed),
        static_cast<unsigned long long>(result.steps),
        static_cast<unsigned long long>(result.climbs),
        static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC,
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

/// Seed after seed until the time is over, one at least; the exit code.
int searchAll(std::span<const Objective> objectives, const Asked& asked) {
    using Clock = std::chrono::steady_clock;
    const auto end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(asked.seconds));
    bool isBroken = false;
    for (SearchOptions options = asked.search; options.seed == asked.search.seed || Clock::now() < end; ++options.seed)
        for (std::size_t i = 0; i < objectives.size(); ++i) {
            SearchOptions own = options;
            own.steps = std::max<std::uint64_t>(options.steps / objectives[i].slowness, 1);
            const auto now = Clock::now();
            const auto share = now + (end - now) / static_cast<std::int64_t>(objectives.size() - i);
            if (asked.seconds > 0) own.isOver = [share] { return Clock::now() >= share; };
            isBroken |= searchOnce(objectives[i], own);
        }
    return isBroken ? 1 : 0;
}

/// The case of `replay` by each objective; the exit code.
int replayAll(std::span<const Objective> objectives, const std::string& replay) {
    bool isBroken = false;
    for (const Objective& objective : objectives) {
        const std::vector<double> genes = genesFrom(replay);
        const double value = objective.score(Genes(genes), Words::No).value;
        print(objective, {genes, value});
        isBroken |= value > objective.bar;
    }
    return isBroken ? 1 : 0;
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
    return asked.replay.empty() ? searchAll(objectives, asked) : replayAll(objectives, asked.replay);
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
