// Reading a .gnm: tables once, pages on demand from any thread.
#pragma once

#include "core/error.h"
#include "core/units.h"
#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"
#include "storage/source.h"

#include <memory>
#include <span>

namespace gnomon::hierarchy {

/// A page whose bytes were read, but are not those that were written: what a checksum or a rule of the format says.
class PageDamage : public Error {
public:
    using Error::Error;
};

/// An open model. The tables are validated when it opens: a damaged table throws Error. Pages come coarsest level
/// first, so the root groups are in the first pages.
class ModelFile {
public:
    /// Throws Error if at `path`, or at such an address, is no whole model, or if its tables would take more than
    /// `tableMemory` while it opens.
    explicit ModelFile(const std::string& path, Bytes tableMemory = {kMostTableBytes});

    /// The same of what `source` reads.
    explicit ModelFile(std::unique_ptr<storage::Source> source, Bytes tableMemory = {kMostTableBytes});

    const std::string& path() const { return source_->name(); }

    const storage::Source& source() const { return *source_; }

    std::uint32_t formatVersion() const { return formatVersion_; }

    const ModelSummary& summary() const { return summary_; }

    std::span<const PageInfo> pages() const { return pages_; }

    std::uint64_t fileBytes() const { return fileBytes_; }

    /// The hash stored in the file: xxh3-128, lower hex, over all bytes after the hash field.
    const std::string& contentHash() const { return contentHash_; }

    /// The hash of the bytes as they are now; reads the whole file.
    std::string computedContentHash() const;

    /// Reads, checks and decodes one page; safe from many threads. Throws PageDamage (path, byte offset) if it is
    /// damaged: wrong checksum, or any index, count or range that does not fit; Error if it cannot be read, though it
    /// was tried several times.
    Page readPage(std::uint32_t page) const;

    /// The same with the `fields` of its vertices, as the summary lists them.
    Page readPage(std::uint32_t page, PageFields& fields) const;

private:
    std::unique_ptr<storage::Source> source_;
    std::uint64_t fileBytes_ = 0;
    std::uint32_t formatVersion_ = kFormatVersion;
    std::string contentHash_;
    ModelSummary summary_;
    std::vector<PageInfo> pages_;
};

} // namespace gnomon::hierarchy
