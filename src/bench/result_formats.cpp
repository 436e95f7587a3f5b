#include "bench/result_formats.h"

#include "bench/verdict_text.h"
#include "core/formatted.h"
#include "telemetry/benchmark_report.h"
#include "telemetry/json_text.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace gnomon::bench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kNsPerMs = 1e6;

/// The median of each repetition, smallest first. Empty without repetitions.
std::vector<double> mediansOf(const Times& times) {
    std::vector<double> medians;
    for (const std::vector<double>& repetition : times)
        if (!repetition.empty()) medians.push_back(telemetry::quantile(repetition, 0.5));
    std::sort(medians.begin(), medians.end());
    return medians;
}

double p99Of(const Times& times) {
    std::vector<double> all;
    for (const std::vector<double>& repetition : times)
        all.insert(all.end(), repetition.begin(), repetition.end());
    return all.empty() ? 0 : telemetry::quantile(all, 0.99);
}

/// Returns `text` without characters that end a cell of a table.
std::string cell(std::string text) {
    for (char& c : text)
        if (c == '|' || c == '\n') c = '/';
    return text;
}

Json latency(const Times& times) {
    const std::vector<double> medians = mediansOf(times);
    Json measure{{"value", kNsPerMs * medianOf(times)}};
    if (medians.size() > 1) {
        measure["lower_value"] = kNsPerMs * medians.front();
        measure["upper_value"] = kNsPerMs * medians.back();
    }
    return measure;
}

/// Returns the name of a measure in the form of Bencher's slugs.
std::string slug(std::string key) {
    std::replace(key.begin(), key.end(), '_', '-');
    return key;
}

std::string errorText(const RunRecord& run, const char* key, double scale, const char* unit) {
    const auto found = run.errors.find(key);
    return found == run.errors.end() ? "-" : formatted("%.4g%s", scale * found->second, unit);
}

} // namespace

std::string summaryMarkdown(const ResultSet& set, const Verdict* verdict) {
    std::string text =
        "| run | median ms | p99 ms | processor ms | wrong pixels | aliasing bound | edge distance px |\n"
        "|---|---|---|---|---|---|---|\n";
    for (const RunRecord& run : set.runs)
        text += "| " + cell(run.name) +
                formatted(" | %.4g | %.4g | %.4g | ", medianOf(run.realMs), p99Of(run.realMs), medianOf(run.cpuMs)) +
                errorText(run, "wrong_pixels_all", 100, "%") + " | " + errorText(run, "promised_aliasing", 1, "") +
                " | " + errorText(run, "shadow_edge_p99_px", 1, "") + " |\n";
    if (verdict == nullptr) return text;
    text += "\n| gate | run | quantity | before | now | change | decision |\n|---|---|---|---|---|---|---|\n";
    for (const Gate& gate : verdict->gates)
        text += "| " + wordOf(gate.kind) + " | " + cell(gate.run) + " | " + cell(gate.quantity) + " | " +
                cell(gate.before) + " | " + cell(gate.after) + " | " +
                (gate.changePercent ? formatted("%+.3g%%", *gate.changePercent) : std::string("-")) + " | " +
                (gate.fails ? "**" + wordOf(gate.decision) + "**" : wordOf(gate.decision)) + " |\n";
    for (const std::string& note : verdict->notes)
        text += "\n" + note + "\n";
    return text;
}

std::string bmfJson(const ResultSet& set) {
    Json document = Json::object();
    for (const RunRecord& run : set.runs) {
        Json measures{{"latency", latency(run.realMs)}};
        if (!run.cpuMs.empty()) measures["cpu-latency"] = latency(run.cpuMs);
        for (const auto* const group : {&run.work, &run.errors})
            for (const auto& [key, value] : *group)
                measures[slug(key)] = {{"value", value}};
        for (const auto& [key, values] : run.process)
            if (!values.empty()) measures[slug(key)] = {{"value", telemetry::quantile(values, 0.5)}};
        document[run.name] = measures;
    }
    return telemetry::jsonText(document, 2) + "\n";
}

std::string actionJson(const ResultSet& set) {
    Json list = Json::array();
    for (const RunRecord& run : set.runs) {
        const std::vector<double> medians = mediansOf(run.realMs);
        Json entry{{"name", run.name}, {"unit", "ms"}, {"value", medianOf(run.realMs)}};
        if (medians.size() > 1) entry["range"] = "± " + formatted("%.4g", (medians.back() - medians.front()) / 2);
        entry["extra"] = formatted("processor ms: %.4g", medianOf(run.cpuMs));
        list.push_back(entry);
        const auto add = [&](const char* what, const std::string& unit, const std::map<std::string, double>& values) {
            for (const auto& [key, value] : values)
                list.push_back({{"name", run.name + " " + key}, {"unit", unit}, {"value", value}, {"extra", what}});
        };
        add("counter", "count", run.work);
        add("error", "value", run.errors);
    }
    return telemetry::jsonText(list, 2) + "\n";
}

} // namespace gnomon::bench
