// An array whose memory is kept from frame to frame, and of which no more is touched than what is written.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

namespace gnomon::exact {

/// Values that mean nothing until they are written: room for many of which few come costs addresses, not memory.
template <class T>
class FrameArray {
public:
    /// Makes room for `count` values; where that takes new memory, what was there is lost.
    void makeRoom(std::size_t count) {
        if (count <= size_) return;
        values_.reset();
        values_ = std::make_unique_for_overwrite<T[]>(count);
        size_ = count;
    }

    /// How many there is room for.
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
    std::unique_ptr<T[]> values_; // NOLINT(modernize-avoid-c-arrays): std::vector would write them all
    std::size_t size_ = 0;
};

} // namespace gnomon::exact
