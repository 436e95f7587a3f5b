#include "core/heap.h"

#include "core/limit_error.h"

#include <cstdint>
#include <fstream>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

namespace gnomon {

void returnFreedMemoryAtOnce() {
    ::mallopt(M_MMAP_THRESHOLD, 1 << 20);
}

void returnFreedMemory() {
    ::malloc_trim(0);
}

bool isAddressSpaceLeft(Bytes size) {
    void* const piece = ::mmap(nullptr, size.count, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return piece != MAP_FAILED && ::munmap(piece, size.count) == 0;
}

Bytes residentSize() {
    std::ifstream statm("/proc/self/statm");
    std::uint64_t total = 0;
    std::uint64_t resident = 0; // in memory pages of the system
    statm >> total >> resident;
    return {resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE))};
}

void requireRoom(Bytes more, Bytes memory, const std::string& where, const std::string& what) {
    const std::uint64_t needed = residentSize().count + more.count;
    if (needed <= memory.count) return;
    throw LimitError(
        Limit::Memory,
        {where,
         "too little memory for " + what,
         std::to_string((needed >> 20U) + 1) + "M or more",
         readableBytes(memory)});
}

} // namespace gnomon
