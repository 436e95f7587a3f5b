// How the heap of the process behaves.
#pragma once

namespace gnomon {

/// From now on, large pieces of memory go back to the system as soon as they are freed. The heap would keep them, in
/// pieces: up to a third on top of what is in use. Slower by a tenth where much is allocated.
void returnFreedMemoryAtOnce();

} // namespace gnomon
