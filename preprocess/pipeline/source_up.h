// Finds the up axis of a source mesh in its comments, names and file format.
#pragma once

#include "hierarchy/up_guess.h"
#include "preprocess/pipeline/build_options.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::pipeline {

/// Returns the up axis that a comment names, for example "Z up", "-y-up", "zup" or "up axis: z". Upper and lower case
/// are equal. Returns nullopt if the comment names no axis or several axes.
std::optional<hierarchy::UpAxis> upOfComment(std::string_view comment);

/// The information about the up axis in the files of a source.
struct SourceUp {
    std::optional<hierarchy::UpAxis> told; // the axis that the file format or a comment states
    // Votes for guessing the axis. They come from the usual axis of this kind of file and of the exporting program.
    hierarchy::UpVotes votes{};
};

/// Reads the names and the first bytes of the files `paths`. In glTF the up axis is y. Other sources can name the up
/// axis or the exporting program in file names, in comments (PLY, OBJ, OFF), or in the header or name of an STL file.
/// `told` is empty if two statements contradict each other. Throws Error if a file cannot be read.
SourceUp upOfSources(const std::vector<std::string>& paths);

/// Stores the up axis that the files `paths` state in `options`. If they state no axis, stores votes for a guess.
void askForUpOfSources(BuildOptions& options, const std::vector<std::string>& paths);

} // namespace gnomon::pipeline
