// --oracle, as render and bench have it.
#pragma once

#include "app/commands.h"
#include "proof/frame_proof.h"

#include <string>

namespace gnomon::app {

/// Whether and how shadows are held against rays.
class OracleOption {
public:
    /// Adds the option to `command`; this must outlive the parsing.
    void addTo(CLI::App& command);

    proof::Oracle mode() const;

private:
    std::string text_;
};

} // namespace gnomon::app
