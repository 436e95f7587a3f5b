// A text file that is written run by run.
#pragma once

#include "core/file.h"

#include <span>
#include <string>

namespace gnomon::measure {

/// Appears under its name when it is complete. Throws Error.
class TextRuns {
public:
    explicit TextRuns(const std::string& path) : file_(path) {}

    void put(const std::string& line) {
        text_ += line;
        constexpr std::size_t kRun = std::size_t{1} << 20U;
        if (text_.size() >= kRun) flush();
    }

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

} // namespace gnomon::measure
