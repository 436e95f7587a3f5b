// The script that draws the theory's figures, embedded at build time from figures.py.
#pragma once

#include <string_view>

namespace gnomon::theory {

extern const std::string_view kFiguresScript;

} // namespace gnomon::theory
