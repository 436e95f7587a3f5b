// The loader threads: they read and decode the pages of a queue, most urgent first.
#pragma once

#include "streaming/page_source.h"

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::streaming {

/// A page that a loader is done with.
struct LoadedPage {
    std::uint32_t page = 0;
    std::unique_ptr<const hierarchy::Page> content; // none if it is damaged or could not be read
    std::string fault;                              // then why
    std::exception_ptr failure = nullptr;           // if it is not damaged, but reading or decoding it failed
};

/// Threads around a queue. All calls come from one thread, the owner's.
class Loaders {
public:
    /// Starts `threadCount` threads, at least one. `source` must outlive them.
    Loaders(const PageSource& source, unsigned threadCount);

    /// Drops what is queued, waits for the pages that are being read and joins.
    ~Loaders();
    Loaders(const Loaders&) = delete;
    Loaders& operator=(const Loaders&) = delete;
    Loaders(Loaders&&) = delete;
    Loaders& operator=(Loaders&&) = delete;

    /// Puts `pages` at the end of the queue.
    void request(std::span<const std::uint32_t> pages);

    /// Empties the queue; answers the pages that no thread had begun.
    std::vector<std::uint32_t> withdraw();

    /// What was finished since the last call; does not wait.
    std::vector<LoadedPage> finished();

    /// Waits until nothing is queued or being read.
    void wait();

private:
    void run();

    const PageSource* source_;
    std::mutex mutex_;
    std::condition_variable work_;
    std::condition_variable idle_;
    std::vector<std::uint32_t> queue_; // the next one last
    std::vector<LoadedPage> finished_;
    unsigned busy_ = 0;
    bool stop_ = false;
    std::vector<std::thread> threads_;
};

} // namespace gnomon::streaming
