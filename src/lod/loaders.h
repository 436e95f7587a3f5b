// Loads pages on several threads: reads and decodes the pages of a queue in order of urgency.
#pragma once

#include "lod/page_source.h"

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::lod {

/// The result of loading one page.
struct LoadedPage {
    std::uint32_t page = 0;
    std::unique_ptr<const hierarchy::Page> content; // null if the page is damaged or could not be read
    std::string fault;                              // the reason, if `content` is null
    // set if the page is not damaged, but could not be read or decoded at present
    std::exception_ptr failure = nullptr;
};

/// Threads that load pages from a queue. Only the thread that owns this object may call its functions.
class Loaders {
public:
    /// Starts `threadCount` loader threads (at least one), which read pages from `source`. `source` must outlive the
    /// threads.
    Loaders(const PageSource& source, unsigned threadCount);

    /// Empties the queue, waits for pages that are being read, and joins the loader threads.
    ~Loaders();
    Loaders(const Loaders&) = delete;
    Loaders& operator=(const Loaders&) = delete;
    Loaders(Loaders&&) = delete;
    Loaders& operator=(Loaders&&) = delete;

    /// Appends `pages` to the queue of pages to load.
    void request(std::span<const std::uint32_t> pages);

    /// Empties the queue, and returns the pages that no thread has started to load.
    std::vector<std::uint32_t> withdraw();

    /// Returns the pages that were loaded since the last call. Does not wait.
    std::vector<LoadedPage> finished();

    /// Waits until the queue is empty and no page is being read.
    void wait();

private:
    void run();

    const PageSource* source_;
    std::mutex mutex_;
    std::condition_variable work_;
    std::condition_variable idle_;
    std::vector<std::uint32_t> queue_; // page ids to load; the next page is the last element
    std::vector<LoadedPage> finished_;
    unsigned busy_ = 0;
    bool stop_ = false;
    std::vector<std::thread> threads_;
};

} // namespace gnomon::lod
