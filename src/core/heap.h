// Controls the heap: returns freed memory to the system, and checks memory use.
#pragma once

#include "core/units.h"

#include <string>

namespace gnomon {

/// Makes the heap return large blocks to the system as soon as they are freed. Otherwise the heap retains fragments of
/// up to a third of the memory in use. In exchange, code with many allocations takes 10% more time.
void returnFreedMemoryAtOnce();

/// Returns the freed memory that the heap still retains to the system.
void returnFreedMemory();

/// Returns true if the address space of the process has room for one block of `size`. A limit of the address space
/// (ulimit -v) can make this false.
bool isAddressSpaceLeft(Bytes size);

/// Returns the resident memory of this process, as the kernel reports it.
Bytes residentSize();

/// Throws LimitError if the process would need more than `memory` with `more` additional bytes. The message says how
/// much memory `what` needs.
void requireRoom(Bytes more, Bytes memory, const std::string& where, const std::string& what);

} // namespace gnomon
