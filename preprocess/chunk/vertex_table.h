// A table with one number per vertex of the source, divided into pages. A page is allocated when one of its numbers is
// first written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::chunk {

/// A table of numbers that are initially zero. Its pages are allocated when they are first written.
template <class T>
class VertexTable {
public:
    static constexpr unsigned kPageBits = 16;
    static constexpr std::uint64_t kPageVertices = std::uint64_t{1} << kPageBits;

    VertexTable() = default;

    explicit VertexTable(std::uint64_t vertices) : pages_((vertices + kPageVertices - 1) >> kPageBits) {}

    T operator[](std::uint64_t vertex) const {
        const T* const page = pages_[vertex >> kPageBits].get();
        return page != nullptr ? page[vertex % kPageVertices] : T{};
    }

    /// Returns a writable reference to the number of `vertex`. Allocates the page of the number if needed.
    T& at(std::uint64_t vertex) {
        std::unique_ptr<T[]>& page = pages_[vertex >> kPageBits];
        if (page == nullptr) {
            page = std::make_unique<T[]>(kPageVertices);
            ++held_;
        }
        return page[vertex % kPageVertices];
    }

    std::size_t pageCount() const { return pages_.size(); }

    /// Returns the kPageVertices numbers of the page with index `page`. Returns an empty span if the page is not
    /// allocated.
    std::span<const T> page(std::size_t page) const {
        return pages_[page] == nullptr ? std::span<const T>() : std::span<const T>(pages_[page].get(), kPageVertices);
    }

    /// Returns the writable numbers of the page with index `page`. Allocates the page if needed.
    std::span<T> pageAt(std::size_t page) {
        at(page << kPageBits);
        return {pages_[page].get(), kPageVertices};
    }

    /// Frees all pages. All numbers are then zero.
    void clear() {
        for (std::unique_ptr<T[]>& page : pages_)
            page.reset();
        held_ = 0;
    }

    /// Returns the number of allocated pages.
    std::size_t held() const { return held_; }

private:
    std::vector<std::unique_ptr<T[]>> pages_;
    std::size_t held_ = 0;
};

/// A paged table with one number per vertex. The numbers have 16 bits, or 32 bits if the largest number needs them.
class VertexNumbers {
public:
    /// Creates a table for `vertices` vertices. Their numbers are at most `largest`.
    VertexNumbers(std::uint64_t vertices, std::uint64_t largest)
        : isWide_(largest > 0xFFFF), narrow_(isWide_ ? 0 : vertices), wide_(isWide_ ? vertices : 0) {}

    std::uint32_t operator[](std::uint64_t vertex) const { return isWide_ ? wide_[vertex] : narrow_[vertex]; }

    void set(std::uint64_t vertex, std::uint32_t number) {
        if (isWide_)
            wide_.at(vertex) = number;
        else
            narrow_.at(vertex) = static_cast<std::uint16_t>(number);
    }

private:
    bool isWide_;
    VertexTable<std::uint16_t> narrow_;
    VertexTable<std::uint32_t> wide_;
};

} // namespace gnomon::chunk
