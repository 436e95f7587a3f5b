// A limit that the caller set and that cannot be kept, in parts: who knows how the limit is asked for says so in those
// words.
#pragma once

#include "core/error.h"

#include <cstdint>
#include <utility>

namespace gnomon {

/// What a build can be limited in. Textures: the source can be read without its textures only.
enum class Limit : std::uint8_t { Memory, ChunkTriangles, StuckTriangles, Textures, SourceRoot };

class LimitError : public Error {
public:
    /// Those of an Error: "WHERE: what: expected E, found F".
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
