// The same code on every set of vector instructions that this machine has.
#pragma once

#include <hwy/targets.h>

namespace gnomon::tests {

/// Calls `run(name)` with each of the instruction sets that were compiled and are supported, the one of scalars too.
template <class Run>
void onEachTarget(const Run& run) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        run(hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

} // namespace gnomon::tests
