// Writing a .gnm: pages in their final order as they come, tables last, the final name when all is there.
#pragma once

#include "core/file.h"
#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"

#include <memory>
#include <optional>
#include <span>
#include <string>

namespace gnomon::hierarchy {

/// A page encoded for the file together with its row of the page table (without the offset).
struct EncodedPage {
    PageInfo info;
    std::vector<std::byte> bytes;
};

/// Encodes `page` and the `fields` of its vertices; a pure function, so pages can be encoded on many threads. The same
/// page gives the same bytes everywhere.
EncodedPage encodePage(const Page& page, const PageFields& fields = {});

/// Writes pages in file order (coarsest level first; ids count from 0 in the order of `append`). Nothing appears under
/// the final name before `finish`.
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

    /// The same for a page whose bytes others write; returns where in the file. They must be there before `finish`,
    /// which then reads all pages for the hash.
    std::uint64_t reserve(const PageInfo& page);

    /// The unfinished file, for others to write pages to; nothing if the output is no file that waits for its name.
    std::optional<std::string> unfinishedPath() const;

    /// Writes the tables, the content hash, flushes and renames. Returns the content hash in lower hex.
    std::string finish(const ModelSummary& summary);

    std::uint64_t bytesWritten() const;

    /// By `finish`, of pages that others have written.
    std::uint64_t bytesRead() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::hierarchy
