// The report of a bench: one self-contained HTML file that opens from disk and needs no network.
#pragma once

#include "report/run_summary.h"

#include <cstdint>
#include <span>

#include <nlohmann/json.hpp>

namespace gnomon::report {

/// A picture of one run. `kind` is picture, reference, difference, texels, aliasing or partitions.
struct Picture {
    std::string run; // equals RunSummary::name
    std::string kind;
    std::vector<std::uint8_t> png;
};

/// One point of the curve of storage factor over number of maps, from the theory (as in figure 12 of Lloyd et al.
/// 2006).
struct StoragePoint {
    std::string scheme;
    int maps = 0;
    double storageFactor = 0;
};

/// The content of the page.
struct Report {
    std::string model;
    std::map<std::string, std::string> context; // machine, build, image size and light, shown below each figure
    std::vector<RunSummary> runs;
    std::vector<Picture> pictures;
    std::vector<StoragePoint> storage;
    std::string csvFile; // links relative to the page; empty: no link
    std::string jsonFile;
};

/// Returns the data of the page: runs, the Pareto front of each error, the sentences, the recommended run, also for
/// each time budget and each limit of wrong pixels, and the correlation of aliasing bound and wrong pixels.
nlohmann::json pageData(const Report& report);

/// Returns the HTML text of the page.
std::string page(const Report& report);

} // namespace gnomon::report
