// Writing of a .gnm file: first the pages in their final order, then the tables. The file gets its final name when it
// is complete.
#pragma once

#include "core/file.h"
#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"

#include <memory>
#include <optional>
#include <span>
#include <string>

namespace gnomon::hierarchy {

/// A page, encoded for the file, with its row of the page table. The row has no offset yet.
struct EncodedPage {
    PageInfo info;
    std::vector<std::byte> bytes;
};

/// Encodes `page` and the `fields` of its vertices. This is a pure function, so many threads can encode pages. The same
/// page gives identical bytes on all platforms.
EncodedPage encodePage(const Page& page, const PageFields& fields = {});

/// A writer of pages in file order, with the coarsest level first. Ids start at 0 and follow the order of `append`. The
/// final name does not exist before `finish`.
class ModelWriter {
public:
    explicit ModelWriter(const std::string& path);
    ~ModelWriter();
    ModelWriter(const ModelWriter&) = delete;
    ModelWriter& operator=(const ModelWriter&) = delete;
    ModelWriter(ModelWriter&&) = delete;
    ModelWriter& operator=(ModelWriter&&) = delete;

    /// Appends a page and returns its id.
    std::uint32_t append(const EncodedPage& page);

    /// Reserves space for a page that another process writes, and returns its offset in the file. The bytes must be
    /// complete before `finish`, which then reads all pages for the hash.
    std::uint64_t reserve(const PageInfo& page);

    /// Returns the path of the unfinished file, so that other processes can write pages to it. Returns nullopt if the
    /// output is a device or a pipe.
    std::optional<std::string> unfinishedPath() const;

    /// Writes the tables and the content hash, flushes and renames the file. Returns the content hash in lower-case
    /// hexadecimal digits.
    std::string finish(const ModelSummary& summary);

    std::uint64_t bytesWritten() const;

    /// Returns the number of bytes that `finish` read of pages that other processes wrote.
    std::uint64_t bytesRead() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::hierarchy
