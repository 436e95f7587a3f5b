// The options of `bench` and `bench build` for gates and for files in other tools' formats.
#pragma once

#include "bench/gates.h"
#include "core/prepared_output.h"

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace gnomon::app {

/// The texts of the options. An empty text means that the option is not given.
struct GateOptions {
    std::string baseline;
    std::string against;
    std::string failAbove;
    std::string workAbove;
    std::string undecided;
    bool allowsOtherMachine = false;
    std::string json;
    std::string verdict;
    std::string summaryMd;
    std::string bmf;
    std::string actionJson;

    bool writesJsonToStdout() const { return json == "-"; }
};

/// Adds the options to `command`.
void addGateOptions(CLI::App& command, GateOptions& options);

/// Returns the limits. Throws UsageError for a wrong value, and for a limit without something to compare with.
bench::Limits limitsOf(const GateOptions& options);

/// Returns the baseline, or nullopt without the option.
std::optional<bench::ResultSet> baselineOf(const GateOptions& options);

/// Returns the names and the values of all options of gates and files, so that a command can leave them out.
std::vector<std::string> optionsWithValue();
std::vector<std::string> flags();

/// The files of a bench. They are created at the start, so that a wrong path fails before the measurements.
class GateFiles {
public:
    explicit GateFiles(const GateOptions& options);

    /// Writes all requested files. With `--json-file -`, prints the JSON.
    void write(const bench::ResultSet& set, const bench::Verdict* verdict);

    /// Writes only the verdict, because nothing was measured.
    void writeVerdict(const bench::Verdict& verdict);

private:
    bool isPrinted_;
    PreparedFile json_;
    PreparedFile verdict_;
    PreparedFile summaryMd_;
    PreparedFile bmf_;
    PreparedFile actionJson_;
};

/// Throws GatesFailed if a gate of `verdict` fails. `against` names the other side.
void conclude(const bench::Verdict& verdict, const std::string& against);

} // namespace gnomon::app
