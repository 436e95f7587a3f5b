// Measures how fast one thread decodes the pages of a model, in triangles and bytes per second.
//
// usage: decode_bench MODEL.gnm [options of Google Benchmark]
//
// The program reads 256 to 511 pages that are evenly distributed over the file. It reads all pages of a smaller model.
// The time contains the read from the page cache of the system, the checksum test and the decoding. `stored_bytes`
// counts the bytes of the pages in the file.
#include "core/error.h"
#include "hierarchy/model_file.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>

namespace gnomon {
namespace {

constexpr std::size_t kPages = 256; // min number of pages to read, if the model has more

void decodePages(benchmark::State& state, const hierarchy::ModelFile& model) {
    const std::size_t step = std::max<std::size_t>(1, model.pages().size() / kPages);
    std::uint64_t triangles = 0;
    std::uint64_t bytes = 0;
    for (auto _ : state)
        for (std::size_t page = 0; page < model.pages().size(); page += step) {
            benchmark::DoNotOptimize(model.readPage(static_cast<std::uint32_t>(page)));
            triangles += model.pages()[page].triangleCount;
            bytes += model.pages()[page].storedBytes;
        }
    state.counters["triangles"] = benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kIsRate);
    state.counters["stored_bytes"] = benchmark::Counter(static_cast<double>(bytes), benchmark::Counter::kIsRate);
}

} // namespace
} // namespace gnomon

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fputs("usage: decode_bench MODEL.gnm [benchmark options]\n", stderr);
        return 2;
    }
    try {
        const gnomon::hierarchy::ModelFile model(argv[1]);
        argv[1] = argv[0];
        int rest = argc - 1;
        benchmark::RegisterBenchmark("decode", [&](benchmark::State& state) { gnomon::decodePages(state, model); });
        benchmark::Initialize(&rest, argv + 1);
        benchmark::RunSpecifiedBenchmarks();
    } catch (const gnomon::Error& error) {
        std::fprintf(stderr, "decode_bench: %s\n", error.what());
        return 1;
    }
}
