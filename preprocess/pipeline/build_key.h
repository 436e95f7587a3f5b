// The key of a build, computed from its input and options. Two builds with equal keys produce the same model.
#pragma once

#include "preprocess/pipeline/build_options.h"

#include <map>
#include <string>

namespace gnomon::pipeline {

/// Returns the build options that affect the bytes of the model, by name.
std::map<std::string, std::string> optionsOf(const BuildOptions& options);

/// Returns the key of a build as one line. The line contains entries "name value" for the input and the options,
/// separated by commas. A build can only resume work that has the same key.
std::string keyOf(const BuildOptions& options);

} // namespace gnomon::pipeline
