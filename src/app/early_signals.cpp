// Holds signals back while the dynamic linker loads the libraries of the program, which takes longer than all else
// before `main`. The linker loads this library first, since the program names it as one that audits (rtld-audit(7)). It
// uses no other library, not even that of C.

/// The linker calls this first of all. Blocks INT, TERM, HUP and PIPE until catchSignals (interruption.h) has installed
/// their handler. Returns 0: then the linker drops this library.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" __attribute__((visibility("default"))) unsigned la_version(unsigned /*version*/) {
    constexpr unsigned long kSetMask = 14;                         // rt_sigprocmask
    constexpr unsigned long kBlock = 0;                            // SIG_BLOCK
    const unsigned long signals = 1U | 2U | 1U << 12U | 1U << 14U; // HUP, INT, PIPE, TERM: bit 0 is signal 1
    unsigned long result = kSetMask;
    register unsigned long bytes asm("r10") = sizeof(signals);
    asm volatile("syscall" : "+a"(result) : "D"(kBlock), "S"(&signals), "d"(0UL), "r"(bytes) : "rcx", "r11", "memory");
    return 0;
}
