// An error because a limit is too small or a value is invalid, in separate parts. The command line adds the name of the
// option that sets the limit.
#pragma once

#include "core/error.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {

/// The limits and values that an error can be about: first those of a build, then those of a picture. `Textures` means
/// that the source is readable only without its textures.
enum class Limit : std::uint8_t {
    Memory,
    ChunkTriangles,
    IrreducibleTriangles,
    Textures,
    SourceRoot,
    PageMemory,
    DrawingMemory,
    ImageSize,
    ShadowTexels,
    FieldOfView,
    NearDepth,
    FarDepth,
    LightDirection
};

class LimitError : public Error {
public:
    /// The parts of the message "WHERE: what: expected E, found F".
    struct Parts {
        std::string where;
        std::string what;
        std::string expected;
        std::string found;
    };

    LimitError(std::vector<Limit> limits, Parts parts)
        : Error(parts.where, parts.what, parts.expected, parts.found),
          limits_(std::move(limits)),
          parts_(std::move(parts)) {}

    LimitError(Limit limit, Parts parts) : LimitError(std::vector{limit}, std::move(parts)) {}

    /// Returns the first limit.
    Limit limit() const { return limits_.front(); }

    /// Returns all limits, at least one. A change of any of them can avoid the error.
    const std::vector<Limit>& limits() const { return limits_; }

    const Parts& parts() const { return parts_; }

private:
    std::vector<Limit> limits_;
    Parts parts_;
};

} // namespace gnomon
