#include "bench/gates.h"

#include "core/formatted.h"
#include "telemetry/benchmark_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <tuple>

namespace gnomon::bench {

namespace {

/// The errors that a gate compares, and their names.
struct ComparedError {
    const char* key;
    const char* name;
};

constexpr std::array kComparedErrors{
    ComparedError{"promised_aliasing", "aliasing bound"},
    ComparedError{"wrong_pixels_all", "wrong pixels"},
    ComparedError{"image_difference", "image difference"},
    ComparedError{"tightness", "tightness"}};

double percentOf(double logRatio) {
    return 100 * std::expm1(logRatio);
}

double logOf(double percent) {
    return std::log1p(percent / 100);
}

/// Returns the change in percent, or nullopt from 0.
std::optional<double> change(double before, double after) {
    if (before == after) return 0;
    if (!(before > 0)) return std::nullopt;
    return 100 * (after / before - 1);
}

Gate gateOf(GateKind kind, const std::string& run, const std::string& quantity, double before, double after) {
    Gate gate;
    gate.kind = kind;
    gate.run = run;
    gate.quantity = quantity;
    gate.before = formatted("%.6g", before);
    gate.after = formatted("%.6g", after);
    gate.changePercent = change(before, after);
    return gate;
}

void fail(Gate& gate) {
    gate.decision = Decision::Fail;
    gate.fails = true;
}

Gate notComparable(
    const std::string& run, const std::string& quantity, const std::string& before, const std::string& after) {
    Gate gate;
    gate.kind = GateKind::Comparable;
    gate.run = run;
    gate.quantity = quantity;
    gate.before = before;
    gate.after = after;
    fail(gate);
    return gate;
}

/// Returns true if `after` exceeds `before` by more than `percent`. Rounding errors of sums do not count.
bool exceeds(double before, double after, double percent) {
    constexpr double kRounding = 1e-9;
    return after > before * (1 + percent / 100) * (1 + kRounding);
}

void addWork(Verdict& verdict, const RunRecord& before, const RunRecord& after, const Limits& limits) {
    for (const auto& [counter, was] : before.work) {
        const auto now = after.work.find(counter);
        if (now == after.work.end()) {
            verdict.gates.push_back(notComparable(after.name, counter, "a measurement", "none"));
            continue;
        }
        Gate gate = gateOf(GateKind::Work, after.name, counter, was, now->second);
        const auto own = limits.workAbove.find(counter);
        gate.limitPercent = own == limits.workAbove.end() ? limits.workAbovePercent : own->second;
        if (exceeds(was, now->second, *gate.limitPercent)) fail(gate);
        verdict.gates.push_back(gate);
    }
}

void addAccuracy(Verdict& verdict, const RunRecord& before, const RunRecord& after) {
    for (const ComparedError& error : kComparedErrors) {
        const auto was = before.errors.find(error.key);
        const auto now = after.errors.find(error.key);
        if (was == before.errors.end() && now == after.errors.end()) continue;
        // A bench that no longer measures its errors must not pass. Exact shadows have no aliasing bound.
        if (now == after.errors.end() && std::string_view(error.key) != "promised_aliasing") {
            verdict.gates.push_back(notComparable(after.name, error.name, "a measurement", "none"));
            continue;
        }
        if (was == before.errors.end() || now == after.errors.end()) {
            verdict.notes.push_back(
                after.name + ": only one side measured the " + error.name + ", so it is not compared");
            continue;
        }
        Gate gate = gateOf(GateKind::Accuracy, after.name, error.name, was->second, now->second);
        gate.limitPercent = 0;
        if (exceeds(was->second, now->second, 0)) fail(gate);
        verdict.gates.push_back(gate);
    }
}

/// Marks work gates of a run that does more work but is more accurate, and in nothing less accurate.
void noteTrade(Verdict& verdict, std::size_t first) {
    const auto begin = verdict.gates.begin() + static_cast<std::ptrdiff_t>(first);
    const auto isWorse = [](const Gate& gate) { return gate.kind == GateKind::Accuracy && gate.fails; };
    const auto isBetter = [](const Gate& gate) {
        return gate.kind == GateKind::Accuracy && gate.changePercent.value_or(0) < -1e-7;
    };
    if (std::any_of(begin, verdict.gates.end(), isWorse) || std::none_of(begin, verdict.gates.end(), isBetter)) return;
    std::for_each(begin, verdict.gates.end(), [](Gate& gate) {
        if (gate.kind == GateKind::Work && gate.fails) gate.note = "more accurate and more work";
    });
}

/// Fills in the interval and the decision of a time gate. For a share, `limit` is a share, not a log ratio.
void setDecision(Gate& gate, const Difference& found, double limit, bool isShare, const Limits& limits) {
    const auto shown = [&](double value) { return isShare ? 100 * value : percentOf(value); };
    gate.changePercent = shown(found.estimate);
    gate.lowPercent = shown(found.low);
    gate.highPercent = shown(found.high);
    gate.limitPercent = shown(limit);
    gate.decision = decide(found, limit);
    if (gate.decision == Decision::Undecided) gate.detectablePercent = shown(detectable(found, limit));
    gate.fails =
        gate.decision == Decision::Fail || (gate.decision == Decision::Undecided && limits.undecided == Decision::Fail);
}

/// Returns the gate of one statistic of frame times. If wall-clock times leave it undecided, processor times decide.
std::optional<Gate> timeGate(
    const RunRecord& before, const RunRecord& after, TimeStatistic statistic, const Limits& limits) {
    const auto found = difference(before.realMs, after.realMs, statistic, limits.pairing);
    if (!found) return std::nullopt;
    const bool isShare = statistic == TimeStatistic::SlowShare;
    const bool isMedian = statistic == TimeStatistic::Median;
    Gate gate;
    gate.run = after.name;
    gate.quantity = isMedian ? "median" : isShare ? "share of frames above twice the median" : "99th percentile";
    const auto text = [&](const Times& times) {
        std::vector<double> all;
        for (const auto& repetition : times)
            all.insert(all.end(), repetition.begin(), repetition.end());
        if (!isShare) return formatted("%.4g ms", telemetry::quantile(all, isMedian ? 0.5 : 0.99));
        std::size_t slow = 0;
        for (const auto& repetition : times)
            slow += static_cast<std::size_t>(std::count_if(repetition.begin(), repetition.end(), [&](double time) {
                return time > 2 * telemetry::quantile(repetition, 0.5);
            }));
        return formatted("%.3g%%", 100 * static_cast<double>(slow) / static_cast<double>(all.size()));
    };
    gate.before = text(before.realMs);
    gate.after = text(after.realMs);
    const double limit = isShare ? slowShareLimitPoints(limits) / 100
                                 : logOf(isMedian ? limits.failAbovePercent : tailLimitPercent(limits));
    setDecision(gate, *found, limit, isShare, limits);
    if (gate.decision != Decision::Undecided) return gate;
    const auto processor = difference(before.cpuMs, after.cpuMs, statistic, limits.pairing);
    if (!isMedian || !processor || decide(*processor, limit) == Decision::Undecided) return gate;
    gate.before = formatted("%.4g ms", medianOf(before.cpuMs));
    gate.after = formatted("%.4g ms", medianOf(after.cpuMs));
    gate.note =
        formatted("wall-clock time is undecided (detectable: %.2g%%); this is processor time", *gate.detectablePercent);
    gate.detectablePercent.reset();
    setDecision(gate, *processor, limit, isShare, limits);
    return gate;
}

void addTimes(
    Verdict& verdict, const RunRecord& before, const RunRecord& after, const Limits& limits, bool onlyMedian) {
    for (const TimeStatistic statistic : {TimeStatistic::Median, TimeStatistic::P99, TimeStatistic::SlowShare}) {
        if (onlyMedian && statistic != TimeStatistic::Median) continue;
        if (auto gate = timeGate(before, after, statistic, limits)) verdict.gates.push_back(*gate);
    }
}

/// Returns the factor of a limit for a single value per side, whose noise is unknown. Memory hardly varies.
double loosened(const char* key, double limit) {
    return key == std::string_view(kPeakMemory) ? limit : std::max(limit, std::log(2));
}

/// Adds the gates of the values per process of the first run: time to the first picture and peak memory.
void addProcess(Verdict& verdict, const RunRecord& before, const RunRecord& after, const Limits& limits) {
    for (const auto& [key, name, percent] :
         {std::tuple{kFirstPicture, "time to the first picture", tailLimitPercent(limits)},
          std::tuple{kPeakMemory, "peak memory", limits.failAbovePercent}}) {
        const auto was = before.process.find(key);
        const auto now = after.process.find(key);
        if (was == before.process.end() || now == after.process.end()) continue;
        const auto asTimes = [](const std::vector<double>& values) {
            Times times;
            for (const double value : values)
                times.push_back({value});
            return times;
        };
        const Times timesBefore = asTimes(was->second);
        const Times timesAfter = asTimes(now->second);
        const auto found = difference(timesBefore, timesAfter, TimeStatistic::Median, limits.pairing);
        if (!found) continue;
        Gate gate = gateOf(GateKind::Time, "", name, medianOf(timesBefore), medianOf(timesAfter));
        const char* const unit = key == std::string_view(kPeakMemory) ? " bytes" : " ms";
        gate.before += unit;
        gate.after += unit;
        if (timesBefore.size() >= 3 && timesAfter.size() >= 3) {
            setDecision(gate, *found, logOf(percent), false, limits);
        } else {
            const double limit = loosened(key, logOf(percent));
            gate.limitPercent = percentOf(limit);
            gate.note = "one process per side";
            if (found->estimate > limit) fail(gate);
        }
        verdict.gates.push_back(gate);
    }
}

/// Returns the name of a run without its first part, the name of the model file. The same model can have two names, and
/// contextGates compares its content.
std::string_view nameWithoutModel(const RunRecord& run) {
    const std::string_view name = run.name;
    return name.substr(std::min(name.find('/'), name.size()));
}

const RunRecord* runNamed(const ResultSet& set, const RunRecord& wanted, bool byLabel) {
    for (const RunRecord& run : set.runs)
        if (byLabel ? run.label == wanted.label : nameWithoutModel(run) == nameWithoutModel(wanted)) return &run;
    return nullptr;
}

void addPages(Verdict& verdict, const RunRecord& run, const std::string& side, const Limits& limits) {
    const std::uint64_t missing = limits.waits ? run.pagesMissing : 0;
    if (run.pagesDamaged == 0 && missing == 0) return;
    Gate gate = notComparable(
        run.name,
        "pages",
        "none damaged and none missing",
        std::to_string(run.pagesDamaged) + " damaged, " + std::to_string(missing) + " missing");
    gate.note = side + " drew without some pages";
    verdict.gates.push_back(gate);
}

/// Adds a note if the times of two binaries differ by less than the layout of the code can cause.
void noteLayout(Verdict& verdict) {
    for (const Gate& gate : verdict.gates) {
        if (gate.kind != GateKind::Time || gate.quantity != "median" || !gate.changePercent) continue;
        if (std::abs(*gate.changePercent) >= kLayoutPercent || *gate.changePercent == 0) continue;
        verdict.notes.push_back(formatted(
            "%s: the times differ by %+.2g%%. Code layout alone can cause a difference below %g%% between binaries.",
            gate.run.c_str(),
            *gate.changePercent,
            kLayoutPercent));
    }
}

} // namespace

double tailLimitPercent(const Limits& limits) {
    constexpr double kMin = 25;
    return std::max(kMin, limits.failAbovePercent);
}

double slowShareLimitPoints(const Limits& limits) {
    constexpr double kMin = 2;
    return std::max(kMin, limits.failAbovePercent / 5);
}

int exitCodeOf(GateKind kind) {
    return kind == GateKind::Comparable ? kNotComparable : kind == GateKind::Time ? kSlower : kWorse;
}

std::string wordOf(GateKind kind) {
    constexpr std::array kWords{"comparable", "work", "accuracy", "time"};
    return kWords[static_cast<std::size_t>(kind)];
}

std::string wordOf(Decision decision) {
    constexpr std::array kWords{"pass", "fail", "undecided"};
    return kWords[static_cast<std::size_t>(decision)];
}

int Verdict::exitCode() const {
    int code = 0;
    for (const Gate& gate : gates)
        if (gate.fails) code = std::max(code, exitCodeOf(gate.kind));
    return code;
}

std::vector<Gate> contextGates(
    const ResultSet& before, const std::map<std::string, std::string>& now, const Limits& limits) {
    constexpr const char* kNotGiven = "not given";
    std::vector<std::string> keys = limits.alikeKeys;
    keys.emplace_back("library_build_type");
    if (!limits.allowsOtherMachine) keys.emplace_back("cpu");
    std::vector<Gate> gates;
    for (const std::string& key : keys) {
        const auto text = [&](const std::map<std::string, std::string>& context) {
            const auto found = context.find(key);
            return found == context.end() ? std::string(kNotGiven) : found->second;
        };
        const std::string was = text(before.context);
        const std::string is = text(now);
        if (was != is) gates.push_back(notComparable("", key, was, is));
    }
    return gates;
}

Verdict judge(const ResultSet& before, const ResultSet& after, const Limits& limits) {
    Verdict verdict;
    std::set<const RunRecord*> compared;
    for (const RunRecord& now : after.runs) {
        const RunRecord* const was = runNamed(before, now, before.hasOnlyTimes);
        if (was == nullptr) {
            verdict.gates.push_back(notComparable(now.name, "run", "missing", "present"));
            continue;
        }
        compared.insert(was);
        addPages(verdict, *was, "the earlier bench", limits);
        addPages(verdict, now, "this bench", limits);
        const std::size_t first = verdict.gates.size();
        if (!before.hasOnlyTimes) {
            addWork(verdict, *was, now, limits);
            addAccuracy(verdict, *was, now);
            noteTrade(verdict, first);
        }
        addTimes(verdict, *was, now, limits, before.hasOnlyTimes);
        if (!before.hasOnlyTimes && &now == &after.runs.front()) addProcess(verdict, *was, now, limits);
    }
    for (const RunRecord& was : before.runs)
        if (!compared.contains(&was)) verdict.gates.push_back(notComparable(was.name, "run", "present", "missing"));
    if (before.hasOnlyTimes)
        verdict.notes.push_back(before.path + ": a file of an earlier form, so only times are compared");
    noteLayout(verdict);
    return verdict;
}

} // namespace gnomon::bench
