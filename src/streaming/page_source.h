// Where pages come from: a file, or a server.
#pragma once

#include "hierarchy/model_file.h"

#include <span>

namespace gnomon::streaming {

/// A page table and its pages.
class PageSource {
public:
    PageSource() = default;
    virtual ~PageSource() = default;
    PageSource(const PageSource&) = delete;
    PageSource& operator=(const PageSource&) = delete;
    PageSource(PageSource&&) = delete;
    PageSource& operator=(PageSource&&) = delete;

    /// The name that messages call it by.
    virtual std::string name() const = 0;

    virtual std::span<const hierarchy::PageInfo> pages() const = 0;

    /// One decoded page; called from many threads at once. Throws PageDamage if it is damaged, anything else if it
    /// cannot be had for now.
    virtual hierarchy::Page readPage(std::uint32_t page) const = 0;
};

/// The pages of an open model, which must outlive it.
class FilePageSource final : public PageSource {
public:
    explicit FilePageSource(const hierarchy::ModelFile& model) : model_(&model) {}

    std::string name() const override { return model_->path(); }

    std::span<const hierarchy::PageInfo> pages() const override { return model_->pages(); }

    hierarchy::Page readPage(std::uint32_t page) const override { return model_->readPage(page); }

private:
    const hierarchy::ModelFile* model_;
};

} // namespace gnomon::streaming
