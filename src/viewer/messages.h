// Short messages that are shown for a while in the window in one printable line, and handed on for whoever reads them
// later.
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::viewer {

/// Seconds since some moment.
using Clock = std::function<double()>;

struct Message {
    std::string text;
    bool isError = false;
    double until = 0; // seconds on the clock
};

class Messages {
public:
    /// `tell` is handed what is noted and what has failed.
    Messages(Clock now, std::function<void(const std::string&)> tell) : now_(std::move(now)), tell_(std::move(tell)) {}

    /// What a key has set: shown for two seconds and told nowhere else. Replaces the last of its kind.
    void show(const std::string& text);

    /// Something done, such as a file saved: six seconds.
    void note(const std::string& text);

    /// Something that could not be done: fifteen seconds.
    void fail(const std::string& reason);

    /// Drops what has been shown long enough; true if anything went.
    bool expire();

    /// Does `action`; what it throws has failed. Whether it threw nothing.
    template <class Do>
    bool attempt(const Do& action) {
        try {
            action();
            return true;
        } catch (const std::exception& error) {
            fail(error.what());
            return false;
        }
    }

    const std::vector<Message>& all() const { return messages_; }

private:
    Clock now_;
    std::function<void(const std::string&)> tell_;
    std::vector<Message> messages_;
    bool lastIsShown_ = false; // the last message is one of `show`
};

} // namespace gnomon::viewer
