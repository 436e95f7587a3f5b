// The results of a bench in the form that gates compare: times, work, errors and memory of each run.
#pragma once

#include "bench/paired_times.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace gnomon::bench {

/// The results of one run.
struct RunRecord {
    std::string name;                     // model/path/scheme/size/error/backend
    std::string label;                    // the settings that vary, as in the log: "z_partitions:4"
    Times realMs;                         // wall-clock time of each frame
    Times cpuMs;                          // processor time of all threads per frame, or one value per repetition
    std::map<std::string, double> work;   // counters that are equal for any number of threads
    std::map<std::string, double> errors; // by column of the log; smaller is more accurate
    // Values of the whole process, one per process: time to the first picture, peak memory.
    std::map<std::string, std::vector<double>> process;
    std::map<std::string, double> facts; // all other figures that a reader can want
    std::uint64_t pagesDamaged = 0;      // total up to the last frame
    std::uint64_t pagesMissing = 0;      // max over all frames
};

/// The results of a bench.
struct ResultSet {
    std::string path; // of its file, for messages
    std::map<std::string, std::string> context;
    std::vector<RunRecord> runs;
    bool hasOnlyTimes = false; // read from a file of an earlier form, which has only a median and a mean per run
};

/// The keys of `RunRecord::process`.
inline constexpr const char* kFirstPicture = "first_picture_ms";
inline constexpr const char* kPeakMemory = "peak_rss_bytes";

/// Adds the repetitions and the values per process of `more` to the runs of `all` with the same name. Adds other runs
/// at the end. Work and errors stay those of `all`.
void append(ResultSet& all, const ResultSet& more);

/// Returns the median of all frame times of `times`, or 0 if there are none.
double medianOf(const Times& times);

} // namespace gnomon::bench
