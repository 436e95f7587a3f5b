// Memory that is overwritten pass by pass.
#pragma once

#include <cstddef>
#include <memory>

namespace gnomon::raster {

/// Grows without keeping or clearing what it held.
template <class T>
class Buffer {
public:
    /// Room for `count`, their values arbitrary.
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
