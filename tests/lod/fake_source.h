// A page source in memory that can be slow or damaged.
#pragma once

#include "cluster_chains.h"
#include "core/error.h"
#include "lod/page_source.h"

#include <atomic>
#include <chrono>
#include <new>
#include <set>
#include <thread>

namespace gnomon::tests {

class FakeSource final : public lod::PageSource {
public:
    explicit FakeSource(const ModelInMemory& model) : model_(&model) {}

    std::string name() const override { return "fake.gnm"; }

    std::span<const hierarchy::PageInfo> pages() const override { return model_->table; }

    hierarchy::Page readPage(std::uint32_t page) const override {
        ++reads;
        isHeld.wait(true);
        if (delay.count() > 0) std::this_thread::sleep_for(delay);
        if (damaged.contains(page))
            throw hierarchy::PageDamage("fake.gnm: byte " + std::to_string(page), "page checksum");
        if (unread.contains(page)) throw Error("fake.gnm: byte " + std::to_string(page), "cannot read");
        if (hasNoMemory) throw std::bad_alloc();
        return *model_->all[page];
    }

    std::set<std::uint32_t> damaged;
    std::set<std::uint32_t> unread;
    std::atomic<bool> hasNoMemory{false};
    std::chrono::microseconds delay{0};
    std::atomic<bool> isHeld{false}; // readers wait until it is false and they are notified
    mutable std::atomic<int> reads{0};

private:
    const ModelInMemory* model_;
};

} // namespace gnomon::tests
