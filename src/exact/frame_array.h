// An array that reuses its memory between frames. Elements that are never written need no physical memory.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

namespace gnomon::exact {

/// An array with undefined initial values. Unused capacity needs address space, but no physical memory.
template <class T>
class FrameArray {
public:
    /// Reserves memory for `count` elements. If the array must grow, the old elements are lost.
    void ensureCapacity(std::size_t count) {
        if (count <= size_) return;
        values_.reset();
        values_ = std::make_unique_for_overwrite<T[]>(count);
        size_ = count;
    }

    /// Returns the number of elements for which memory is reserved.
    std::size_t size() const { return size_; }

    T& operator[](std::size_t i) { return values_[i]; }

    const T& operator[](std::size_t i) const { return values_[i]; }

    const T* begin() const { return values_.get(); }

    const T* end() const { return values_.get() + size_; }

    void swap(FrameArray& other) noexcept {
        values_.swap(other.values_);
        std::swap(size_, other.size_);
    }

private:
    std::unique_ptr<T[]> values_; // NOLINT(modernize-avoid-c-arrays): std::vector would initialise all elements
    std::size_t size_ = 0;
};

} // namespace gnomon::exact
