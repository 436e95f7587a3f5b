// The comparison of this program with another one: the command line of each side, and the processes that measure.
#pragma once

#include "app/gate_options.h"
#include "bench/against.h"

namespace gnomon::app {

/// The default number of measurements of each side. Google's U test needs 9.
inline constexpr int kRepetitionsAgainst = 9;

/// Returns the arguments of the bench of one side: those of this process without gates, files and repetitions. If
/// `otherModel` is not empty, it replaces `model`.
std::vector<std::string> wordsOfSide(const std::string& model, const std::string& otherModel);

/// Runs `gnomon bench` of one side with one repetition and returns its results. Without `isFirst`, leaves out the
/// comparison with the ground truth. Throws Error if the program fails.
bench::ResultSet benchOnce(const bench::Side& side, bool isFirst);

/// Returns the verdict of both sides: context, work, accuracy and time.
bench::Verdict verdictOf(const bench::ResultSet& before, const bench::ResultSet& after, const bench::Limits& limits);

/// What `compareSides` needs besides the two sides.
struct Comparison {
    int repetitions = kRepetitionsAgainst;
    bench::MeasureOnce measure;
    bench::Limits limits;
    bool isSilent = false; // print no gates, because stdout has the JSON
};

/// Measures both sides, prints the gates and writes the files. Throws GatesFailed.
void compareSides(
    const bench::Side& before,
    const bench::Side& after,
    const Comparison& comparison,
    GateFiles& files,
    Progress& progress);

/// A folder for temporary files, which the destructor removes with its content.
class ScratchFolder {
public:
    /// Creates the folder in `parent`.
    explicit ScratchFolder(const std::string& parent);
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ScratchFolder(ScratchFolder&&) = delete;
    ScratchFolder& operator=(ScratchFolder&&) = delete;

    std::string file(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_;
};

} // namespace gnomon::app
