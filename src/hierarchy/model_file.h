// Reads a .gnm model file. The tables are read when it is opened, and pages on demand from any thread.
#pragma once

#include "core/error.h"
#include "core/units.h"
#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"
#include "hierarchy/source/source.h"

#include <memory>
#include <span>

namespace gnomon::hierarchy {

/// The error for a damaged page. Its bytes were read, but the checksum is wrong or the page violates a rule of the
/// format.
class PageDamage : public Error {
public:
    using Error::Error;
};

/// An open model file. The constructor checks the tables and throws Error if a table is damaged. The coarsest pages
/// come first in the file, so the root groups are in the first pages.
class ModelFile {
public:
    /// Opens the model at `path`, which is a file or a web address. Throws Error if there is no complete model, or if
    /// reading its tables would need more memory than `tableMemory`.
    explicit ModelFile(const std::string& path, Bytes tableMemory = {kMaxTableBytes});

    /// Opens the model whose bytes `source` reads. Throws Error if it is no complete model, or if reading its tables
    /// would need more memory than `tableMemory`.
    explicit ModelFile(std::unique_ptr<hierarchy::Source> source, Bytes tableMemory = {kMaxTableBytes});

    const std::string& path() const { return source_->name(); }

    const hierarchy::Source& source() const { return *source_; }

    std::uint32_t formatVersion() const { return formatVersion_; }

    const ModelSummary& summary() const { return summary_; }

    std::span<const PageInfo> pages() const { return pages_; }

    std::uint64_t fileBytes() const { return fileBytes_; }

    /// Returns the content hash that the file stores: the xxh3-128 hash of all bytes after the hash itself, in
    /// lower-case hexadecimal digits.
    const std::string& contentHash() const { return contentHash_; }

    /// Reads the whole file and returns the hash of its present bytes, for comparison with contentHash.
    std::string computedContentHash() const;

    /// Reads, checks and decodes one page of the model. Any thread can call this. Throws PageDamage with path and byte
    /// offset if the checksum is wrong, or if an index, count or range is invalid. Throws Error if reading fails after
    /// several attempts.
    Page readPage(std::uint32_t page) const;

    /// Reads a page, and the fields of its vertices into `fields`. The fields are in the order of the summary.
    Page readPage(std::uint32_t page, PageFields& fields) const;

private:
    std::unique_ptr<hierarchy::Source> source_;
    std::uint64_t fileBytes_ = 0;
    std::uint32_t formatVersion_ = kFormatVersion;
    std::string contentHash_;
    ModelSummary summary_;
    std::vector<PageInfo> pages_;
};

} // namespace gnomon::hierarchy
