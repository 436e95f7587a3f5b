// The verdict of the gates as text and as JSON.
#pragma once

#include "bench/gates.h"

namespace gnomon::bench {

/// Returns one line per gate with its figures, and then the notes.
std::string verdictText(const Verdict& verdict);

/// Returns one line that names all failing gates. Returns an empty text if no gate fails.
std::string failureLine(const Verdict& verdict);

/// Returns the JSON document of --verdict: `verdict` (pass, fail or undecided), `exit_code`, `gates` and `notes`.
std::string verdictJson(const Verdict& verdict);

} // namespace gnomon::bench
