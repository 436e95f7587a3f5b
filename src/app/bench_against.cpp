#include "app/bench_against.h"

#include "app/console.h"
#include "bench/alike_keys.h"
#include "bench/child_process.h"
#include "bench/result_json.h"
#include "bench/verdict_text.h"
#include "core/error.h"
#include "core/file.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace gnomon::app {

namespace {

/// Returns the arguments of this process after its subcommand.
std::vector<std::string> ownArguments() {
    const std::string text = readTextFile("/proc/self/cmdline");
    std::vector<std::string> words;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find('\0', start), text.size());
        words.push_back(text.substr(start, end - start));
        start = end + 1;
    }
    words.erase(words.begin(), words.begin() + std::min<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(words.size())));
    return words;
}

} // namespace

ScratchFolder::ScratchFolder(const std::string& parent) : path_(parent + "/gnomon_bench_XXXXXX") {
    if (::mkdtemp(path_.data()) == nullptr) throw Error(parent, "cannot make a temporary folder here");
}

ScratchFolder::~ScratchFolder() {
    std::error_code failure;
    std::filesystem::remove_all(path_, failure);
}

std::vector<std::string> wordsOfSide(const std::string& model, const std::string& otherModel) {
    bench::RemovedOptions removed{optionsWithValue(), flags(), {}, {}};
    for (const char* option : {"--against-model", "--repetitions", "--progress"})
        removed.withValue.emplace_back(option);
    std::vector<std::string> words = bench::withoutOptions(ownArguments(), removed);
    if (!otherModel.empty()) std::replace(words.begin(), words.end(), model, otherModel);
    return words;
}

bench::ResultSet benchOnce(const bench::Side& side, bool isFirst) {
    const ScratchFolder folder(std::filesystem::temp_directory_path().string());
    const std::string file = folder.file("bench.json");
    const bench::RemovedOptions groundTruth{{}, {}, {"--oracle"}, {"full", "exact"}};
    std::vector<std::string> words = isFirst ? side.words : bench::withoutOptions(side.words, groundTruth);
    words.insert(words.begin(), side.program);
    words.insert(words.end(), {"--repetitions", "1", "--json-file", file, "--progress", "none"});
    const bench::ChildResult child = bench::runChild(words);
    if (child.exitCode != 0)
        throw Error(side.program, "its bench failed", "exit code 0", std::to_string(child.exitCode));
    bench::ResultSet set = bench::readResultSet(file);
    set.path = side.program;
    return set;
}

bench::Verdict verdictOf(const bench::ResultSet& before, const bench::ResultSet& after, const bench::Limits& limits) {
    bench::Verdict verdict = bench::judge(before, after, limits);
    const std::vector<bench::Gate> context = bench::contextGates(before, after.context, limits);
    verdict.gates.insert(verdict.gates.begin(), context.begin(), context.end());
    return verdict;
}

void compareSides(
    const bench::Side& before,
    const bench::Side& after,
    const Comparison& comparison,
    GateFiles& files,
    Progress& progress) {
    const bench::BothSides sides =
        bench::measureAlternately(before, after, comparison.repetitions, comparison.measure, progress);
    bench::Limits limits = comparison.limits;
    if (limits.alikeKeys.empty())
        limits.alikeKeys = bench::alikeKeys(sides.before, sides.after.context, limits.allowsOtherModel);
    const bench::Verdict verdict = verdictOf(sides.before, sides.after, limits);
    files.write(sides.after, &verdict);
    if (!comparison.isSilent) std::fputs(bench::verdictText(verdict).c_str(), stdout);
    requirePrinted();
    conclude(verdict, before.program);
}

} // namespace gnomon::app
