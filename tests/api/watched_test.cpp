#include "api/plain_errors.h"
#include "api/watched.h"

#include <gtest/gtest.h>

namespace gnomon::api {

TEST(PlainErrors, AreThoseOfTheStandardLibrary) {
    const auto fails = [] { withPlainErrors([] { throw settings::UsageError{"--size", "--size: no size"}; }); };
    EXPECT_THROW(fails(), std::runtime_error);
    EXPECT_EQ(withPlainErrors([] { return 7; }), 7);
}

} // namespace gnomon::api
