// Writes a text file in blocks of about 1 MiB.
#pragma once

#include "core/file.h"

#include <span>
#include <string>

namespace gnomon::task {

/// A buffered writer of a text file. The file appears under its name after `commit`. All functions throw Error.
class TextRuns {
public:
    explicit TextRuns(const std::string& path) : file_(path) {}

    /// Appends `line` to the file. The line must end with a line break.
    void put(const std::string& line) {
        text_ += line;
        constexpr std::size_t kRun = std::size_t{1} << 20U;
        if (text_.size() >= kRun) flush();
    }

    /// Writes the remaining text, and renames the file to its final name.
    void commit() {
        flush();
        file_.commit();
    }

private:
    void flush() {
        file_.file().writeAt(offset_, std::as_bytes(std::span(text_)));
        offset_ += text_.size();
        text_.clear();
    }

    AtomicFile file_;
    std::uint64_t offset_ = 0;
    std::string text_;
};

} // namespace gnomon::task
