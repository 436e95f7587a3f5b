// A memory buffer that is reused from pass to pass. Each pass overwrites the content.
#pragma once

#include <cstddef>
#include <memory>

namespace gnomon::raster {

/// An array that grows on demand. Growth neither copies nor clears the elements.
template <class T>
class Buffer {
public:
    /// Returns memory for `count` elements with undefined values.
    T* reserve(std::size_t count) {
        if (count > capacity_) {
            memory_ = std::make_unique_for_overwrite<T[]>(count);
            capacity_ = count;
        }
        return memory_.get();
    }

private:
    std::unique_ptr<T[]> memory_;
    std::size_t capacity_ = 0;
};

} // namespace gnomon::raster
