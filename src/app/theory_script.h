// The script that draws the theory's figures, embedded at build time from theory_figures.py.
#pragma once

#include <string_view>

namespace gnomon::app {

extern const std::string_view kTheoryFiguresScript;

} // namespace gnomon::app
