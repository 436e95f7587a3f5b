// Computes many results in parallel, and passes them on in order.
#pragma once

#include <tbb/parallel_pipeline.h>

#include <cstddef>
#include <memory>
#include <optional>

namespace gnomon::chunk {

/// Calls `make(i)` in parallel for each i in [first, end), and `take(i, result)` with the results in ascending order of
/// i. Only one call of `take` runs at a time. At most `atOnce` results are in memory.
template <class Make, class Take>
void makeInOrder(std::size_t first, std::size_t end, std::size_t atOnce, const Make& make, const Take& take) {
    using Result = decltype(make(first));

    struct Work {
        std::size_t index;
        std::optional<Result> result;
    };

    std::size_t next = first;
    tbb::parallel_pipeline(
        atOnce,
        tbb::make_filter<void, std::shared_ptr<Work>>(
            tbb::filter_mode::serial_in_order,
            [&](tbb::flow_control& flow) -> std::shared_ptr<Work> {
                if (next < end) return std::make_shared<Work>(Work{next++, {}});
                flow.stop();
                return nullptr;
            }) &
            tbb::make_filter<std::shared_ptr<Work>, std::shared_ptr<Work>>(
                tbb::filter_mode::parallel,
                [&](std::shared_ptr<Work> work) {
                    work->result.emplace(make(work->index));
                    return work;
                }) &
            tbb::make_filter<std::shared_ptr<Work>, void>(
                tbb::filter_mode::serial_in_order,
                [&](const std::shared_ptr<Work>& work) { take(work->index, std::move(*work->result)); }));
}

} // namespace gnomon::chunk
