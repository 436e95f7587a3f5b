// A read that fails once is read again, one that fails for good is no damage, and no memory for zstd is bad_alloc.
#include "failing_calls.h"
#include "hierarchy/model_file.h"
#include "hierarchy/model_writer.h"
#include "hierarchy/page_codec.h"
#include "page_equality.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <thread>

namespace gnomon::hierarchy {
namespace {

using tests::failingCalls;

class FailingCalls : public testing::Test {
protected:
    void SetUp() override {
        const char* test = testing::UnitTest::GetInstance()->current_test_info()->name();
        path = testing::TempDir() + "gnomon_" + test + ".gnm";
        tests::writeModel(model, path);
    }

    void TearDown() override {
        failingCalls().reads = 0;
        failingCalls().contexts = 0;
        failingCalls().compressions = 0;
    }

    tests::TinyModel model = tests::makeTinyModel({});
    std::string path;
};

TEST_F(FailingCalls, AReadThatFailsOnceOrTwiceIsReadAgain) {
    const ModelFile file(path);
    for (const int failures : {1, 2}) {
        failingCalls().reads = failures;
        EXPECT_TRUE(samePage(file.readPage(1), model.pages[1]));
        EXPECT_EQ(failingCalls().reads, 0);
    }
    failingCalls().reads = 2;
    EXPECT_EQ(ModelFile(path).contentHash(), file.contentHash());
}

TEST_F(FailingCalls, AReadThatAlwaysFailsIsNoDamage) {
    const ModelFile file(path);
    failingCalls().reads = 1000;
    try {
        file.readPage(1);
        FAIL() << "it was read";
    } catch (const PageDamage& damage) {
        FAIL() << damage.what();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("cannot read: Input/output error"), std::string::npos);
    }
    EXPECT_LT(failingCalls().reads, 1000 - 1) << "it was tried once only";
    EXPECT_THROW(ModelFile{path}, Error);
}

/// Runs `work` on a thread that has no context of zstd's yet.
template <class Work>
void onAFreshThread(const Work& work) {
    std::thread(work).join();
}

TEST_F(FailingCalls, NoMemoryForZstdIsNoDamageAndPasses) {
    const Page& page = model.pages.back();
    onAFreshThread([&] {
        failingCalls().contexts = 1;
        EXPECT_THROW(encodePageBytes(page), std::bad_alloc);
        failingCalls().compressions = 1;
        EXPECT_THROW(encodePageBytes(page), std::bad_alloc);
        const EncodedPage encoded = encodePage(page);
        failingCalls().contexts = 1;
        EXPECT_THROW(decodePageBytes(encoded.bytes, encoded.info), std::bad_alloc);
        EXPECT_TRUE(samePage(decodePageBytes(encoded.bytes, encoded.info), page));
    });
}

} // namespace
} // namespace gnomon::hierarchy
