// What makes two builds the same.
#pragma once

#include "preprocess/pipeline/build_options.h"

#include <map>
#include <string>

namespace gnomon::pipeline {

/// The options that change bytes.
std::map<std::string, std::string> optionsOf(const BuildOptions& options);

/// What is built from what, in one line of entries "name value" that commas part: a resumed build must have the same.
std::string keyOf(const BuildOptions& options);

} // namespace gnomon::pipeline
