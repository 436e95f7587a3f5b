// Execution of a test with each vector instruction set of this machine.
#pragma once

#include <gtest/gtest.h>

#include <hwy/targets.h>

namespace gnomon::proximity {

/// Calls `check()` once per compiled and supported instruction set.
template <class Check>
void onEachProcessor(Check check) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        check();
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

} // namespace gnomon::proximity
