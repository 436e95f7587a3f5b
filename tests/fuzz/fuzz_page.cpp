// One page: its row of the page table, then its stored bytes, which seeds hold unpacked so that zstd is in nobody's
// way.
#include "harness.h"
#include "hierarchy/bytes.h"
#include "hierarchy/codec/cluster_order.h"
#include "hierarchy/file_layout.h"
#include "hierarchy/page_codec.h"
#include "hierarchy/validation.h"
#include "tests/support/each_target.h"

#include <cstdlib>

namespace gnomon::fuzz {
namespace {

using namespace hierarchy;

/// Aborts unless `page` is stored as bytes that say the same.
void storeAndRead(const Page& page, const PageFields& fields, PageInfo info) {
    try {
        const std::vector<std::byte> stored = encodePageBytes(page, fields);
        info.storedBytes = static_cast<std::uint32_t>(stored.size());
        tests::onEachTarget([&](const char* /*name*/) {
            PageFields again;
            const Page read = decodePageBytes(stored, info, again);
            if (encodePageBytes(read, again) != stored) std::abort();
        });
    } catch (const Damage&) {
        std::abort();
    }
}

} // namespace
} // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon::hierarchy;
    try {
        const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
        ByteReader in(bytes);
        PageInfo info = takePageRow(in);
        info.storedBytes = static_cast<std::uint32_t>(in.remaining());
        if (rowFault(info, Grid{})) return 0;
        PageFields fields;
        Page page = decodePageBytes(bytes.last(in.remaining()), info, fields);
        // What is taken for a page is one, whatever the bytes said.
        if (pageFault(page)) std::abort();
        // And it is stored as it was read, and as a build would order it.
        gnomon::fuzz::storeAndRead(page, fields, info);
        orderForCoding(page, fields);
        gnomon::fuzz::storeAndRead(page, fields, info);
    } catch (const Damage&) { // refused in words
    }
    return 0;
}
