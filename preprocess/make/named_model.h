// The kinds of model that `gnomon make` knows, by name.
#pragma once

#include "preprocess/make/made_model.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::make {

/// In the order of the help.
std::vector<std::string> modelNames();

/// What the kind is made with when nobody says.
std::uint64_t defaultTriangles(const std::string& kind);

/// A model of `triangles` within 2%. Throws Error if that is fewer than the kind can be made of.
std::unique_ptr<MadeModel> makeNamedModel(const std::string& kind, std::uint64_t triangles, std::uint64_t seed);

} // namespace gnomon::make
