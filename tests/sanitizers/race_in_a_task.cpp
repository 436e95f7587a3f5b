// Lets TBB's tasks write what the caller reads after them, in a loop and in a pipeline; with the name of either as its
// argument, the tasks of that one all write to one place.
#include "preprocess/chunk/in_order.h"

#include <tbb/parallel_for.h>

#include <array>
#include <iostream>
#include <numeric>
#include <string_view>

int main(int argumentCount, char** arguments) {
    const std::string_view racing = argumentCount > 1 ? arguments[1] : "";
    std::array<std::size_t, 5000> from = {};
    std::array<std::size_t, 5000> to = {};
    std::iota(from.begin(), from.end(), 0U);
    for (int round = 0; round < 50; ++round) {
        tbb::parallel_for(
            std::size_t{0}, to.size(), [&](std::size_t i) { to[racing == "loop" ? 0 : i] = from[i] + 1; });
        from.swap(to);
    }
    std::size_t sum = 0;
    gnomon::chunk::makeInOrder(
        0,
        to.size(),
        4,
        [&](std::size_t i) { return to[racing == "pipeline" ? 0 : i] += from[i]; },
        [&](std::size_t, std::size_t made) { sum += made; });
    std::cout << "sum " << sum + to.back() << '\n';
}
