// The comparison of two programs that measure alternately, in the order ABBA.
#pragma once

#include "bench/gates.h"
#include "core/progress.h"

#include <functional>

namespace gnomon::bench {

/// One side of the comparison: a program and its arguments.
struct Side {
    std::string program;
    std::vector<std::string> words;
};

/// The results of both sides. Repetition i of both sides was measured at the same time.
struct BothSides {
    ResultSet before;
    ResultSet after;
};

/// Measures one repetition of a side. `isFirst` is true in the first repetition, which also measures accuracy.
using MeasureOnce = std::function<ResultSet(const Side& side, bool isFirst)>;

/// Measures both sides `repetitions` times: old, new, new, old, and so on. Each order occurs equally often, so a
/// machine that becomes slower slows both sides. Progress advances by 1 per measurement.
BothSides measureAlternately(
    const Side& before, const Side& after, int repetitions, const MeasureOnce& measure, Progress& progress);

/// Options with a value, or flags, that are removed from a command line.
struct RemovedOptions {
    std::vector<std::string> withValue;
    std::vector<std::string> flags;
    std::vector<std::string> withOptionalValue; // a following word of `optionalValues` is its value
    std::vector<std::string> optionalValues;
};

/// Returns `words` without the options `removed`, which can have the forms "--option VALUE" and "--option=VALUE".
std::vector<std::string> withoutOptions(const std::vector<std::string>& words, const RemovedOptions& removed);

} // namespace gnomon::bench
