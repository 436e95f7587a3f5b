// Execution of a test with each vector instruction set of this machine.
#pragma once

#include <hwy/targets.h>

namespace gnomon::tests {

/// Calls `run(name)` with each compiled and supported instruction set, including the scalar one.
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
