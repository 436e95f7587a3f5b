// The option --oracle of render and bench, which selects the ground truth for shadows.
#pragma once

#include "app/commands.h"
#include "proof/frame_proof.h"

#include <string>

namespace gnomon::app {

/// The option --oracle and its value.
class OracleOption {
public:
    /// Adds the option to `command`. This object must exist until the command line is parsed.
    void addTo(CLI::App& command);

    /// Returns the chosen ground truth, or Oracle::None without the option.
    proof::Oracle mode() const;

private:
    std::string text_;
};

} // namespace gnomon::app
