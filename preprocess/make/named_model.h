// The kinds of models of `gnomon make`, by name.
#pragma once

#include "preprocess/make/made_model.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::make {

/// Returns the names in the order of the help text.
std::vector<std::string> modelNames();

/// Returns the default number of triangles of a kind.
std::uint64_t defaultTriangles(const std::string& kind);

/// Returns a model with `triangles` triangles, within 2%. Throws Error if the kind needs more triangles.
std::unique_ptr<MadeModel> makeNamedModel(const std::string& kind, std::uint64_t triangles, std::uint64_t seed);

} // namespace gnomon::make
