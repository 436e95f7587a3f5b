// The report: one self-contained HTML file that opens from disk and asks nothing of any network.
#pragma once

#include "report/run_summary.h"

#include <cstdint>
#include <span>

#include <nlohmann/json.hpp>

namespace gnomon::report {

/// A picture of one run: `kind` is one of picture, reference, difference, texels, aliasing, partitions.
struct Picture {
    std::string run; // RunSummary::name
    std::string kind;
    std::vector<std::uint8_t> png;
};

/// One point of the storage factor against the number of maps (figure 12's shape), from the theory.
struct StoragePoint {
    std::string scheme;
    int maps = 0;
    double storageFactor = 0;
};

/// All that the page shows.
struct Report {
    std::string model;
    std::map<std::string, std::string> context; // machine, build, image size, light: shown under every figure
    std::vector<RunSummary> runs;
    std::vector<Picture> pictures;
    std::vector<StoragePoint> storage;
    std::string csvFile; // links, relative to the page; empty: none
    std::string jsonFile;
};

/// The page's data: runs, the Pareto front of every error, the sentences, the correlation of promise and truth.
nlohmann::json pageData(const Report& report);

/// The page itself.
std::string page(const Report& report);

} // namespace gnomon::report
