#include "lod/loaders.h"

#include "core/check.h"
#include "core/error.h"

#include <algorithm>
#include <exception>
#include <string>
#include <system_error>
#include <utility>

namespace gnomon::lod {
namespace {

LoadedPage load(const PageSource& source, std::uint32_t page) {
    LoadedPage result;
    result.page = page;
    try {
        result.content = std::make_unique<const hierarchy::Page>(source.readPage(page));
    } catch (const hierarchy::PageDamage& damage) {
        result.fault = damage.what();
    } catch (const std::exception& error) {
        result.fault = error.what();
        result.failure = std::current_exception();
    }
    return result;
}

} // namespace

Loaders::Loaders(const PageSource& source, unsigned threadCount) : source_(&source) {
    GNOMON_CHECK_OP(threadCount, >=, 1U);
    for (unsigned i = 0; i < threadCount; ++i) {
        try {
            threads_.emplace_back([this] { run(); });
        } catch (const std::system_error& error) {
            if (threads_.empty())
                throw Error("loading of pages", std::string("cannot start a thread: ") + error.what());
            break; // if the system starts no more threads, fewer loader threads are sufficient
        }
    }
}

Loaders::~Loaders() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        queue_.clear();
    }
    work_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
}

void Loaders::request(std::span<const std::uint32_t> pages) {
    if (pages.empty()) return;
    {
        const std::lock_guard lock(mutex_);
        queue_.insert(queue_.begin(), pages.rbegin(), pages.rend());
        finished_.reserve(
            // Reserves the memory for the loaded pages here, because a loader thread cannot report a failed allocation.
            finished_.size() + busy_ + queue_.size());
    }
    work_.notify_all();
}

std::vector<std::uint32_t> Loaders::withdraw() {
    const std::lock_guard lock(mutex_);
    return std::exchange(queue_, {});
}

std::vector<LoadedPage> Loaders::finished() {
    const std::lock_guard lock(mutex_);
    return std::exchange(finished_, {});
}

void Loaders::wait() {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return queue_.empty() && busy_ == 0; });
}

void Loaders::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        work_.wait(lock, [this] { return stop_ || !queue_.empty(); });
        if (stop_) return;
        const std::uint32_t page = queue_.back();
        queue_.pop_back();
        ++busy_;
        lock.unlock();
        LoadedPage loaded = load(*source_, page);
        lock.lock();
        finished_.push_back(std::move(loaded));
        --busy_;
        if (queue_.empty() && busy_ == 0) idle_.notify_all();
    }
}

} // namespace gnomon::lod
