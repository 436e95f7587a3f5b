// The label of tests that a build with a sanitizer leaves out.
#pragma once

#include <gtest/gtest.h>

/// Put this first in a test, or in the SetUp of a fixture, that would take more than ten seconds in a build with a
/// sanitizer: it skips the test there. Shorter tests run the same code.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GNOMON_TOO_LONG_FOR_SANITIZERS() GTEST_SKIP() << "too long in a build with a sanitizer"
#else
#define GNOMON_TOO_LONG_FOR_SANITIZERS() static_cast<void>(0)
#endif
