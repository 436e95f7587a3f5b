// The loader threads: order, withdrawal, damage, and that nothing is lost or read twice.
#include "core/error.h"
#include "lod/loaders.h"
#include "lod/page_source.h"
#include "lod/page_store.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <thread>

#include <unistd.h>

namespace gnomon::lod {
namespace {

/// Pages whose level is their number; those above 90 are damaged. Readers wait while it is held.
class NumberedSource final : public PageSource {
public:
    std::string name() const override { return "numbered"; }

    std::span<const hierarchy::PageInfo> pages() const override { return {}; }

    hierarchy::Page readPage(std::uint32_t page) const override {
        {
            const std::lock_guard lock(mutex_);
            order_.push_back(page);
        }
        isHeld.wait(true);
        if (page > 90) throw Error("numbered", "page " + std::to_string(page) + " is damaged");
        hierarchy::Page result;
        result.level = page;
        return result;
    }

    std::vector<std::uint32_t> order() const {
        const std::lock_guard lock(mutex_);
        return order_;
    }

    void release() {
        isHeld = false;
        isHeld.notify_all();
    }

    std::atomic<bool> isHeld{false};

private:
    mutable std::mutex mutex_;
    mutable std::vector<std::uint32_t> order_;
};

std::set<std::uint32_t> pagesOf(const std::vector<LoadedPage>& loaded) {
    std::set<std::uint32_t> pages;
    for (const LoadedPage& page : loaded)
        EXPECT_TRUE(pages.insert(page.page).second) << "read twice";
    return pages;
}

void waitForReads(const NumberedSource& source, std::size_t count) {
    while (source.order().size() < count)
        std::this_thread::yield();
}

TEST(Loaders, ReadAllThatIsRequestedOnce) {
    for (const unsigned threads : {1U, 4U}) {
        const NumberedSource source;
        Loaders loaders(source, threads);
        std::vector<std::uint32_t> pages(80);
        for (std::uint32_t i = 0; i < pages.size(); ++i)
            pages[i] = i;
        loaders.request(std::span(pages).first(50));
        loaders.request({});
        loaders.request(std::span(pages).subspan(50));
        loaders.wait();
        const std::vector<LoadedPage> loaded = loaders.finished();
        EXPECT_EQ(pagesOf(loaded), std::set<std::uint32_t>(pages.begin(), pages.end()));
        for (const LoadedPage& page : loaded) {
            ASSERT_NE(page.content, nullptr);
            EXPECT_EQ(page.content->level, page.page);
            EXPECT_EQ(page.fault, "");
        }
        EXPECT_TRUE(loaders.finished().empty()) << "each is told once";
        EXPECT_TRUE(loaders.withdraw().empty());
        loaders.wait(); // with nothing to do it does not wait
    }
}

TEST(Loaders, OneThreadReadsInTheOrderOfTheRequests) {
    NumberedSource source;
    source.isHeld = true;
    Loaders loaders(source, 1);
    const std::vector<std::uint32_t> first{7, 3, 9};
    const std::vector<std::uint32_t> second{1, 5};
    loaders.request(first);
    loaders.request(second);
    source.release();
    loaders.wait();
    EXPECT_EQ(source.order(), (std::vector<std::uint32_t>{7, 3, 9, 1, 5}));
}

TEST(Loaders, WhatIsWithdrawnIsNotRead) {
    NumberedSource source;
    source.isHeld = true;
    Loaders loaders(source, 2);
    const std::vector<std::uint32_t> pages{1, 2, 3, 4, 5, 6};
    loaders.request(pages);
    waitForReads(source, 2); // one in each thread's hands
    const std::vector<std::uint32_t> withdrawn = loaders.withdraw();
    EXPECT_EQ(std::set<std::uint32_t>(withdrawn.begin(), withdrawn.end()), (std::set<std::uint32_t>{3, 4, 5, 6}));
    EXPECT_TRUE(loaders.finished().empty()) << "none is done yet";
    source.release();
    loaders.wait();
    EXPECT_EQ(pagesOf(loaders.finished()), (std::set<std::uint32_t>{1, 2}));
    EXPECT_EQ(source.order().size(), 2U);
}

TEST(Loaders, ADamagedPageComesWithItsReasonAndTheOthersCome) {
    const NumberedSource source;
    Loaders loaders(source, 3);
    const std::vector<std::uint32_t> pages{1, 91, 2, 92};
    loaders.request(pages);
    loaders.wait();
    const std::vector<LoadedPage> loaded = loaders.finished();
    EXPECT_EQ(pagesOf(loaded).size(), 4U);
    for (const LoadedPage& page : loaded) {
        EXPECT_EQ(page.content == nullptr, page.page > 90);
        EXPECT_EQ(page.fault, page.page > 90 ? "numbered: page " + std::to_string(page.page) + " is damaged" : "");
    }
}

TEST(Loaders, EndWithAQueueThatIsNotEmpty) {
    NumberedSource source;
    source.isHeld = true;
    {
        Loaders loaders(source, 2);
        const std::vector<std::uint32_t> pages{1, 2, 3, 4, 5, 6, 7, 8};
        loaders.request(pages);
        waitForReads(source, 2);
        source.release();
    }
    EXPECT_LE(source.order().size(), 8U);
    EXPECT_GE(source.order().size(), 2U);
}

TEST(FilePageSource, ReadsThePagesOfTheFile) {
    const std::string path = testing::TempDir() + "gnomon_page_source_" + std::to_string(::getpid()) + ".gnm";
    const tests::TinyModel model = tests::makeTinyModel({});
    tests::writeModel(model, path);
    const hierarchy::ModelFile file(path);
    const FilePageSource source(file);
    EXPECT_EQ(source.name(), path);
    ASSERT_EQ(source.pages().size(), model.pages.size());
    for (std::uint32_t page = 0; page < model.pages.size(); ++page) {
        const hierarchy::Page read = source.readPage(page);
        EXPECT_EQ(read.vertices, model.pages[page].vertices);
        EXPECT_EQ(read.triangles, model.pages[page].triangles);
        // What a page is charged with is what its arrays take.
        EXPECT_EQ(
            decodedBytes(source.pages()[page]).count,
            sizeof(hierarchy::Page) + read.groups.size() * sizeof(hierarchy::Group) +
                read.clusters.size() * sizeof(hierarchy::Cluster) +
                read.refinements.size() * sizeof(hierarchy::Refinement) +
                read.vertices.size() * sizeof(hierarchy::Vertex) + read.triangles.size() * sizeof(hierarchy::Triangle));
    }
    ::unlink(path.c_str());
}

} // namespace
} // namespace gnomon::lod
