// One page: its row of the page table, then its stored bytes, which seeds hold unpacked so that zstd is in nobody's
// way.
#include "harness.h"
#include "hierarchy/bytes.h"
#include "hierarchy/file_layout.h"
#include "hierarchy/page_codec.h"
#include "hierarchy/validation.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon::hierarchy;
    bool isStored = false;
    try {
        const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
        ByteReader in(bytes);
        PageInfo info = takePageRow(in);
        info.storedBytes = static_cast<std::uint32_t>(in.remaining());
        if (rowFault(info, Grid{})) return 0;
        PageFields fields;
        const Page page = decodePageBytes(bytes.last(in.remaining()), info, fields);
        // What is taken for a page is one, whatever the bytes said.
        if (pageFault(page)) std::abort();
        // And it is stored as it was read.
        const std::vector<std::byte> stored = encodePageBytes(page, fields);
        info.storedBytes = static_cast<std::uint32_t>(stored.size());
        isStored = true;
        PageFields again;
        const Page read = decodePageBytes(stored, info, again);
        if (encodePageBytes(read, again) != stored) std::abort();
    } catch (const Damage&) { // refused in words, but for what was just stored
        if (isStored) std::abort();
    }
    return 0;
}
