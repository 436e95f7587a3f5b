// Finds the up axis of a source from its comments, names and file format.
#pragma once

#include "hierarchy/up_guess.h"
#include "preprocess/pipeline/build_options.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::pipeline {

/// Returns the up axis that a comment names, for example "Z up", "-y-up", "zup" or "up axis: z", ignoring case. Returns
/// nothing if it names no axis or several.
std::optional<hierarchy::UpAxis> upOfComment(std::string_view comment);

/// The up axis according to the files of a source.
struct SourceUp {
    std::optional<hierarchy::UpAxis> told; // from the format or from comments
    hierarchy::UpVotes votes{};            // votes for a guess, from the usual axis of this kind of file and program
};

/// Reads the names and the first bytes of the files `paths`. In glTF, y is up. Comments of PLY, OBJ and OFF files, the
/// name or header of an STL file, and file names can name the up axis or the exporting program. `told` is empty if two
/// statements contradict each other. Throws Error if a file cannot be read.
SourceUp upOfSources(const std::vector<std::string>& paths);

/// Sets the up axis of `options` from the files, or the votes for a guess.
void askForUpOfSources(BuildOptions& options, const std::vector<std::string>& paths);

} // namespace gnomon::pipeline
