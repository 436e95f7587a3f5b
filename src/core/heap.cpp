#include "core/heap.h"

#include <malloc.h>
#include <sys/mman.h>

namespace gnomon {

void returnFreedMemoryAtOnce() {
    ::mallopt(M_MMAP_THRESHOLD, 1 << 20);
}

bool isAddressSpaceLeft(Bytes size) {
    void* const piece = ::mmap(nullptr, size.count, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return piece != MAP_FAILED && ::munmap(piece, size.count) == 0;
}

} // namespace gnomon
