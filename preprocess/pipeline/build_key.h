// The key of a build. Two builds with equal keys produce the same model.
#pragma once

#include "preprocess/pipeline/build_options.h"

#include <map>
#include <string>

namespace gnomon::pipeline {

/// Returns the options that affect the bytes of the model.
std::map<std::string, std::string> optionsOf(const BuildOptions& options);

/// Returns the key of a build: the input and the options as one line of entries "name value", separated by commas. A
/// build can only resume work that has the same key.
std::string keyOf(const BuildOptions& options);

} // namespace gnomon::pipeline
