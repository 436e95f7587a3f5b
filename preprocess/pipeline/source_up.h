// Which way is up as a source's own words and its kind have it.
#pragma once

#include "hierarchy/up_guess.h"
#include "preprocess/pipeline/build_options.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::pipeline {

/// The axis that a comment calls up: "Z up", "-y-up", "zup", "up axis: z", in any case; nothing where it calls none or
/// several.
std::optional<hierarchy::UpAxis> upOfComment(std::string_view comment);

/// What sources say of the axis that is up.
struct SourceUp {
    std::optional<hierarchy::UpAxis> told; // by a specification or by words
    hierarchy::UpVotes votes{};            // of a guess, by what usually is up in files of this kind and program
};

/// Reads the names and the beginnings of the files `paths`: y is up in glTF; comments of PLY, OBJ and OFF files, the
/// name or the header of an STL and names of files may say what is up, and which program wrote the file. Nothing is
/// told where two contradict each other. Throws Error for a file that cannot be read.
SourceUp upOfSources(const std::vector<std::string>& paths);

/// Asks for what is told, or else for a guess with these votes.
void askForUpOfSources(BuildOptions& options, const std::vector<std::string>& paths);

} // namespace gnomon::pipeline
