#include "core/heap.h"

#include <malloc.h>

namespace gnomon {

void returnFreedMemoryAtOnce() {
    ::mallopt(M_MMAP_THRESHOLD, 1 << 20);
}

} // namespace gnomon
