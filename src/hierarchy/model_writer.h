// Writes a .gnm model file: first the pages in their final order, and then the tables. The file gets its final name
// when it is complete.
#pragma once

#include "core/file.h"
#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"

#include <memory>
#include <optional>
#include <span>
#include <string>

namespace gnomon::hierarchy {

/// A page, encoded as bytes for the file, and its row of the page table. The row has no file offset yet.
struct EncodedPage {
    PageInfo info;
    std::vector<std::byte> bytes;
};

/// Encodes `page` and the `fields` of its vertices as bytes. The function is pure, so many threads can encode pages.
/// The bytes are identical on all platforms.
EncodedPage encodePage(const Page& page, const PageFields& fields = {});

/// Writes the pages of a model in file order, with the coarsest level first. Page ids start at 0 in the order of
/// `append`. The file does not have its final name before `finish`.
class ModelWriter {
public:
    explicit ModelWriter(const std::string& path);
    ~ModelWriter();
    ModelWriter(const ModelWriter&) = delete;
    ModelWriter& operator=(const ModelWriter&) = delete;
    ModelWriter(ModelWriter&&) = delete;
    ModelWriter& operator=(ModelWriter&&) = delete;

    /// Appends an encoded page to the file and returns its id.
    std::uint32_t append(const EncodedPage& page);

    /// Reserves space in the file for a page that another process writes. Returns the offset of the page. The bytes
    /// must be complete before `finish`, which reads all pages of other processes to compute the hash.
    std::uint64_t reserve(const PageInfo& page);

    /// Returns the path of the unfinished file, into which other processes can write pages. Returns nullopt if the
    /// output is a device or a pipe.
    std::optional<std::string> unfinishedPath() const;

    /// Writes the tables and the content hash, flushes the file and renames it to its final name. Returns the content
    /// hash in lower-case hexadecimal digits.
    std::string finish(const ModelSummary& summary);

    std::uint64_t bytesWritten() const;

    /// Returns how many bytes `finish` has read to compute the hash. They are the bytes of pages that other processes
    /// wrote.
    std::uint64_t bytesRead() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::hierarchy
