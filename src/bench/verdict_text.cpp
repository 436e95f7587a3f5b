#include "bench/verdict_text.h"

#include "core/formatted.h"
#include "telemetry/json_text.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace gnomon::bench {

namespace {

std::string figuresOf(const Gate& gate) {
    if (!gate.changePercent && !gate.limitPercent) return "expected " + gate.before + ", found " + gate.after;
    std::string text = gate.before + " before, " + gate.after + " now";
    if (gate.changePercent)
        text += formatted(gate.lowPercent ? ", change of paired times %+.3g%%" : ", %+.3g%%", *gate.changePercent);
    if (gate.lowPercent) text += formatted(" (99%% interval %+.3g%% to %+.3g%%)", *gate.lowPercent, *gate.highPercent);
    if (gate.limitPercent) text += formatted(", limit %+.3g%%", *gate.limitPercent);
    if (gate.detectablePercent)
        text += formatted(", the smallest detectable change is %.3g%%", *gate.detectablePercent);
    return text;
}

std::string lineOf(const Gate& gate) {
    const std::string decision = gate.decision == Decision::Fail ? "FAIL" : wordOf(gate.decision);
    std::string text = decision + std::string(10 - decision.size(), ' ') + wordOf(gate.kind);
    if (!gate.run.empty()) text += " " + gate.run;
    text += " " + gate.quantity + ": " + figuresOf(gate);
    return gate.note.empty() ? text : text + "; " + gate.note;
}

nlohmann::json figure(const std::optional<double>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json();
}

} // namespace

std::string verdictText(const Verdict& verdict) {
    std::string text;
    for (const Gate& gate : verdict.gates)
        text += lineOf(gate) + "\n";
    for (const std::string& note : verdict.notes)
        text += note + "\n";
    return text;
}

std::string failureLine(const Verdict& verdict) {
    std::string text;
    const auto count =
        std::count_if(verdict.gates.begin(), verdict.gates.end(), [](const Gate& gate) { return gate.fails; });
    if (count == 0) return text;
    text = count == 1 ? "1 gate fails: " : std::to_string(count) + " gates fail: ";
    bool isFirst = true;
    for (const Gate& gate : verdict.gates) {
        if (!gate.fails) continue;
        text += std::string(isFirst ? "" : "; ") + wordOf(gate.kind) + " " + gate.run + (gate.run.empty() ? "" : " ") +
                gate.quantity + ": " + figuresOf(gate) + (gate.note.empty() ? "" : ", " + gate.note);
        isFirst = false;
    }
    return text;
}

std::string verdictJson(const Verdict& verdict) {
    const int code = verdict.exitCode();
    const bool isUndecided = std::any_of(verdict.gates.begin(), verdict.gates.end(), [](const Gate& gate) {
        return gate.decision == Decision::Undecided;
    });
    nlohmann::ordered_json document{
        {"verdict",
         code != 0     ? "fail"
         : isUndecided ? "undecided"
                       : "pass"},
        {"exit_code", code},
        {"gates", nlohmann::ordered_json::array()},
        {"notes", verdict.notes}};
    for (const Gate& gate : verdict.gates)
        document["gates"].push_back(
            {{"kind", wordOf(gate.kind)},
             {"run", gate.run},
             {"quantity", gate.quantity},
             {"before", gate.before},
             {"after", gate.after},
             {"change_percent", figure(gate.changePercent)},
             {"low_percent", figure(gate.lowPercent)},
             {"high_percent", figure(gate.highPercent)},
             {"limit_percent", figure(gate.limitPercent)},
             {"detectable_percent", figure(gate.detectablePercent)},
             {"decision", wordOf(gate.decision)},
             {"fails", gate.fails},
             {"note", gate.note}});
    return telemetry::jsonText(document, 2) + "\n";
}

} // namespace gnomon::bench
