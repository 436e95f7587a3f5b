// The gates of a bench: they compare two result sets and return a verdict about comparability, work, accuracy and time.
#pragma once

#include "bench/result_set.h"

#include <functional>
#include <optional>
#include <span>

namespace gnomon::bench {

enum class GateKind : std::uint8_t { Comparable, Work, Accuracy, Time };

/// The exit codes of failing gates. A higher code has priority.
inline constexpr int kSlower = 3;
inline constexpr int kWorse = 4;
inline constexpr int kNotComparable = 5;

/// The limits of the gates.
struct Limits {
    double failAbovePercent = 10;
    double workAbovePercent = 0;
    std::map<std::string, double> workAbove; // percent, by counter
    Decision undecided = Decision::Pass;     // the result of an undecided gate: Pass or Fail
    bool allowsOtherMachine = false;
    bool allowsOtherModel = false; // the models differ, but have the same source
    bool waits = true;             // each frame waits for its pages, so that a missing page is a fault
    Pairing pairing = Pairing::None;
    std::vector<std::string> alikeKeys; // keys of the context that must be equal
};

/// The result of one gate.
struct Gate {
    GateKind kind = GateKind::Time;
    std::string run;      // name of the run; empty for the whole bench
    std::string quantity; // such as "median", "triangles" or "model_content_hash"
    std::string before;   // the figures as text, with units
    std::string after;
    std::optional<double> changePercent; // or percentage points for a share
    std::optional<double> lowPercent;    // 99% interval of the change
    std::optional<double> highPercent;
    std::optional<double> limitPercent;
    std::optional<double> detectablePercent; // the smallest change that an undecided gate could have detected
    Decision decision = Decision::Pass;
    bool fails = false; // also if the gate is undecided and --undecided is fail
    std::string note;
};

/// The result of all gates.
struct Verdict {
    std::vector<Gate> gates;
    std::vector<std::string> notes;

    /// Returns 0 if no gate fails, otherwise the failing gate's code with the highest priority.
    int exitCode() const;
};

int exitCodeOf(GateKind kind);
std::string wordOf(GateKind kind);
std::string wordOf(Decision decision);

/// Returns a gate per key of the context that must be equal in both benches but differs. These are the keys in
/// `limits.alikeKeys`, the build type, and the processor unless `allowsOtherMachine` is true. A file of an earlier form
/// need not have the processor.
std::vector<Gate> contextGates(
    const ResultSet& before, const std::map<std::string, std::string>& now, const Limits& limits);

/// Returns the gates of all runs: missing runs and pages, work, accuracy and time. `before` of an earlier form has only
/// times; a note says so. Does not compare the contexts.
Verdict judge(const ResultSet& before, const ResultSet& after, const Limits& limits);

/// Returns the smallest growth of a 99th percentile or of the time to the first picture that fails, in percent. These
/// quantities vary more than medians.
double tailLimitPercent(const Limits& limits);

/// Returns the smallest growth of the share of slow frames that fails, in percentage points: a fifth of the limit for
/// medians, but at least 2.
double slowShareLimitPoints(const Limits& limits);

/// The difference in percent that the layout of the code in memory alone can cause between two binaries (Mytkowicz et
/// al. 2009).
inline constexpr double kLayoutPercent = 2;

} // namespace gnomon::bench
