// Which way is up as a source's own words have it.
#pragma once

#include "preprocess/pipeline/build_options.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::pipeline {

/// The axis that a comment calls up: "Z up", "-y-up", "up axis: z", in any case; nothing where it calls none or
/// several.
std::optional<hierarchy::UpAxis> upOfComment(std::string_view comment);

/// That of the comments in the headers of those of `paths` that are PLY files, and y of those that are glTF; nothing
/// where two contradict each other or none says a word. Throws Error for a file that cannot be read.
std::optional<hierarchy::UpAxis> upOfSources(const std::vector<std::string>& paths);

/// Asks for that up, if there is one.
void askForUpOfSources(BuildOptions& options, const std::vector<std::string>& paths);

} // namespace gnomon::pipeline
