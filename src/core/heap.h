// How the heap of the process behaves, and what of it is in memory.
#pragma once

#include "core/units.h"

#include <string>

namespace gnomon {

/// From now on, large pieces of memory go back to the system as soon as they are freed. The heap would keep them, in
/// pieces: up to a third on top of what is in use. Slower by a tenth where much is allocated.
void returnFreedMemoryAtOnce();

/// Gives memory that is freed but not yet returned back to the system.
void returnFreedMemory();

/// Whether so much could be had now in one piece, as far as a limit of the process's address space decides that.
bool isAddressSpaceLeft(Bytes size);

/// What this process has in memory, as the kernel counts it.
Bytes residentSize();

/// Throws LimitError unless `more` fits into `memory` beside what this process has. The error says how much memory
/// `what` needs.
void requireRoom(Bytes more, Bytes memory, const std::string& where, const std::string& what);

} // namespace gnomon
