// An error that occurs if a limit is too small or a value is invalid. Its message is stored as separate parts, so that
// the command line can add the name of the option that sets the limit.
#pragma once

#include "core/error.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {

/// The limits and values that can cause a LimitError: first those of a build, then those of a picture. `Textures` means
/// that the source can be read only without its textures.
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
    /// The four parts of an error message with the form "WHERE: what: expected E, found F".
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

    /// Returns the limits that caused the error, at least one. The user can avoid the error by changing any of them.
    const std::vector<Limit>& limits() const { return limits_; }

    const Parts& parts() const { return parts_; }

private:
    std::vector<Limit> limits_;
    Parts parts_;
};

} // namespace gnomon
