// What stands between a file and an OpenMesh reader: passes on only lines that the reader cannot trip over.
#pragma once

#include "core/file.h"
#include "preprocess/read/byte_stream.h"

#include <optional>
#include <streambuf>
#include <string>
#include <string_view>

namespace gnomon::read {

/// Judges the lines of one format. OpenMesh's readers skip what they cannot parse, or index past the end of an empty
/// face; so whatever they would trip over must be refused here, and what they need not see is left out.
class LineGuard {
public:
    LineGuard() = default;
    virtual ~LineGuard() = default;
    LineGuard(const LineGuard&) = delete;
    LineGuard& operator=(const LineGuard&) = delete;
    LineGuard(LineGuard&&) = delete;
    LineGuard& operator=(LineGuard&&) = delete;

    /// The reading begins (again).
    virtual void begin() {}

    /// What the reader shall see of `line` (without its line end); nothing if it need not see it. Throws Error(where,
    /// ...) for a bad line.
    virtual std::optional<std::string> pass(std::string_view line, const std::string& where) = 0;

    /// The file is over. Throws Error(where, ...) if it may not be.
    virtual void end(const std::string& /*where*/) {}
};

/// A stream buffer that feeds the guarded lines of a file, and knows the line in hand. Can only be rewound to the
/// start.
class GuardedLines final : public std::streambuf {
public:
    GuardedLines(const InputFile& file, LineGuard& guard);

    /// Lets the guard judge the lines that the reader has not asked for.
    void readOut();

    /// "PATH:LINE" of the line in hand.
    std::string where() const;

protected:
    int_type underflow() override;
    pos_type seekoff(off_type offset, std::ios_base::seekdir direction, std::ios_base::openmode mode) override;
    pos_type seekpos(pos_type position, std::ios_base::openmode mode) override;

private:
    bool readLine();

    const InputFile& file_;
    LineGuard& guard_;
    ByteStream stream_;
    std::string line_;   ///< as it stands in the file
    std::string passed_; ///< what the reader sees
    std::uint64_t lineNumber_ = 0;
    bool isEnded_ = false;
};

/// A stream buffer over the bytes of a file, which knows its place.
class GuardedBytes final : public std::streambuf {
public:
    explicit GuardedBytes(const InputFile& file) : stream_(file, 0) {}

    /// "PATH: byte N" of the next byte.
    std::string where() const;

protected:
    int_type underflow() override;

private:
    ByteStream stream_;
    std::size_t given_ = 0;
};

} // namespace gnomon::read
