// Control of the heap: return of freed memory to the system, and checks of memory use.
#pragma once

#include "core/units.h"

#include <string>

namespace gnomon {

/// Makes the heap return large blocks to the system as soon as they are freed. Otherwise the heap keeps fragments of up
/// to a third of the memory in use. In return, code with many allocations takes 10% more time.
void returnFreedMemoryAtOnce();

/// Returns freed memory that the heap still keeps to the system.
void returnFreedMemory();

/// Returns true if the address space of the process has room for one block of `size`. A limit of the address space
/// (ulimit -v) can make this false.
bool isAddressSpaceLeft(Bytes size);

/// Returns the resident memory of this process, as the kernel reports it.
Bytes residentSize();

/// Throws LimitError if the resident memory plus `more` exceeds `memory`. The message says how much memory `what`
/// needs.
void requireRoom(Bytes more, Bytes memory, const std::string& where, const std::string& what);

} // namespace gnomon
