// Creates the test models of `gnomon make` by the name of their kind (statue, plant, planes).
#pragma once

#include "preprocess/make/made_model.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::make {

/// Returns the names of all kinds of test models, in the order of the help text.
std::vector<std::string> modelNames();

/// Returns the default number of triangles for test models of the kind `kind`.
std::uint64_t defaultTriangles(const std::string& kind);

/// Returns a test model of the kind `kind` with `triangles` triangles, within 2%. Throws Error if the kind is unknown
/// or needs more triangles.
std::unique_ptr<MadeModel> makeNamedModel(const std::string& kind, std::uint64_t triangles, std::uint64_t seed);

} // namespace gnomon::make
