// A test on every kind of processor that this one can stand for.
#pragma once

#include <gtest/gtest.h>

#include <hwy/targets.h>

namespace gnomon::proximity {

/// Calls `check()` once for each instruction set that vector lanes were compiled for and that this machine has.
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
