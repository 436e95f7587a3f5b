// An error about a limit of the caller, in separate parts. The command line replaces parts of the message with the name
// of its option.
#pragma once

#include "core/error.h"

#include <cstdint>
#include <utility>

namespace gnomon {

/// The limit that a build exceeded. Textures means that the source can only be read without its textures.
enum class Limit : std::uint8_t { Memory, ChunkTriangles, StuckTriangles, Textures, SourceRoot };

class LimitError : public Error {
public:
    /// The parts of the message "WHERE: what: expected E, found F".
    struct Parts {
        std::string where;
        std::string what;
        std::string expected;
        std::string found;
    };

    LimitError(Limit limit, Parts parts)
        : Error(parts.where, parts.what, parts.expected, parts.found), limit_(limit), parts_(std::move(parts)) {}

    Limit limit() const { return limit_; }

    const Parts& parts() const { return parts_; }

private:
    Limit limit_;
    Parts parts_;
};

} // namespace gnomon
