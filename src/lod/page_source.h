// Loads the pages of a model from a file or a server.
#pragma once

#include "hierarchy/model_file.h"

#include <span>

namespace gnomon::lod {

/// A model's page table, and access to its pages.
class PageSource {
public:
    PageSource() = default;
    virtual ~PageSource() = default;
    PageSource(const PageSource&) = delete;
    PageSource& operator=(const PageSource&) = delete;
    PageSource(PageSource&&) = delete;
    PageSource& operator=(PageSource&&) = delete;

    /// Returns the name of the file or server for messages.
    virtual std::string name() const = 0;

    virtual std::span<const hierarchy::PageInfo> pages() const = 0;

    /// Reads and decodes one page. Can run on many threads at once. Throws PageDamage if the page is damaged, and any
    /// other exception if the page is not available at present.
    virtual hierarchy::Page readPage(std::uint32_t page) const = 0;
};

/// Reads pages from an open model. The model must outlive this object.
class FilePageSource final : public PageSource {
public:
    explicit FilePageSource(const hierarchy::ModelFile& model) : model_(&model) {}

    std::string name() const override { return model_->path(); }

    std::span<const hierarchy::PageInfo> pages() const override { return model_->pages(); }

    hierarchy::Page readPage(std::uint32_t page) const override { return model_->readPage(page); }

private:
    const hierarchy::ModelFile* model_;
};

} // namespace gnomon::lod
