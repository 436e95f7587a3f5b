#include "bench/baseline.h"

#include "core/error.h"
#include "core/json_file.h"
#include "settings/removed_words.h"
#include "settings/table.h"

#include <array>
#include <set>
#include <sstream>

namespace gnomon::bench {

namespace {

/// The keys of the context, besides the settings, on which frame times depend.
constexpr std::array kAlike{"model_content_hash", "path_content_hash", "frames", "real_time", "backend", "threads"};

/// Throws UsageError if a setting in the context or in a run's name of `baseline` has a value that no longer exists.
void refuseRemovedWords(const Baseline& baseline) {
    for (const settings::Setting& setting : settings::table()) {
        if (const auto stated = baseline.context.find(setting.column()); stated != baseline.context.end())
            settings::refuseRemovedWord(setting.option(), stated->second);
        const std::string key = setting.column() + ":";
        for (const auto& [name, p50Ms] : baseline.p50Ms) {
            std::istringstream parts(name);
            for (std::string part; std::getline(parts, part, '/');)
                if (part.starts_with(key)) settings::refuseRemovedWord(setting.option(), part.substr(key.size()));
        }
    }
}

} // namespace

Baseline readBaseline(const std::string& path) {
    const nlohmann::ordered_json document = readJsonFile(path);
    const auto part = [&](const char* key) {
        return document.is_object() && document.contains(key) ? document[key] : nlohmann::ordered_json();
    };
    Baseline baseline{path, {}, {}};
    const auto context = part("context");
    const auto benchmarks = part("benchmarks");
    if (!context.is_object() || !benchmarks.is_array())
        throw Error(
            path, "this file is not a bench result", R"({"context": {...}, "benchmarks": [...]})", "something else");
    for (const auto& [key, value] : context.items())
        if (value.is_string()) baseline.context[key] = value.get<std::string>();
    for (const auto& run : benchmarks) {
        const bool isRun = run.is_object() && run.contains("name") && run["name"].is_string() && run.contains("p50") &&
                           run["p50"].is_number();
        if (!isRun)
            throw Error(
                path + ": benchmark " + std::to_string(baseline.p50Ms.size()),
                "this entry is not a run",
                R"({"name": text, "p50": number, ...})",
                "something else");
        baseline.p50Ms[run["name"].get<std::string>()] = run["p50"].get<double>();
    }
    refuseRemovedWords(baseline);
    return baseline;
}

void requireComparable(const Baseline& baseline, const std::map<std::string, std::string>& context) {
    const auto requireAlike = [&](const std::string& key, const std::string& now, const std::string& before) {
        if (now != before) throw Error(baseline.path, "the baseline is of another bench: " + key, now, before);
    };
    const auto requireStated = [&](const std::string& key) {
        const auto before = baseline.context.find(key);
        requireAlike(key, context.at(key), before == baseline.context.end() ? "not given" : before->second);
    };
    for (const char* key : kAlike)
        requireStated(key);
    for (const settings::Setting& setting : settings::table()) {
        if (!setting.description().statedAs.empty()) requireStated(setting.description().statedAs);
        if (!setting.description().isSwept) continue;
        const auto before = baseline.context.find(setting.column());
        const auto now = context.find(setting.column());
        if (before != baseline.context.end() && now != context.end())
            requireAlike(setting.column(), now->second, before->second);
    }
}

std::vector<std::string> notCompared(const Baseline& baseline, std::span<const report::RunSummary> summaries) {
    std::vector<std::string> names;
    std::set<std::string> known;
    for (const report::RunSummary& now : summaries) {
        known.insert(now.name);
        if (!baseline.p50Ms.contains(now.name)) names.push_back(now.name);
    }
    for (const auto& [name, p50Ms] : baseline.p50Ms)
        if (!known.contains(name)) names.push_back(name);
    return names;
}

void requireComplete(const Baseline& baseline, std::span<const report::RunSummary> summaries, bool waits) {
    for (const report::RunSummary& now : summaries) {
        const std::uint64_t missing = waits ? now.pagesMissing : 0;
        if (now.pagesDamaged == 0 && missing == 0) continue;
        throw Error(
            baseline.path,
            now.name + " drew without some pages, so its times cannot be compared",
            "none damaged and none missing",
            std::to_string(now.pagesDamaged) + " damaged, " + std::to_string(missing) + " missing");
    }
}

bool isSlower(double beforeMs, double nowMs, double failAbovePercent) {
    return nowMs > beforeMs * (1 + failAbovePercent / 100);
}

void requireNotSlower(
    const Baseline& baseline, std::span<const report::RunSummary> summaries, double failAbovePercent) {
    bool hasCompared = false;
    for (const report::RunSummary& now : summaries) {
        const auto before = baseline.p50Ms.find(now.name);
        if (before == baseline.p50Ms.end()) continue;
        hasCompared = true;
        if (isSlower(before->second, now.p50Ms, failAbovePercent))
            throw Error(
                baseline.path,
                now.name + " became slower",
                "a median of at most " + std::to_string(before->second * (1 + failAbovePercent / 100)) + " ms",
                std::to_string(now.p50Ms) + " ms");
    }
    if (!hasCompared)
        throw Error(baseline.path, "the baseline has none of these runs", summaries.front().name, "other names");
}

} // namespace gnomon::bench
