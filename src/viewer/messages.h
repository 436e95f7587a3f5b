// Short messages that the window shows for some seconds, and that it forwards to a log.
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::viewer {

/// A clock that returns seconds since an arbitrary moment.
using Clock = std::function<double()>;

/// A message of one printable line.
struct Message {
    std::string text;
    bool isError = false;
    double until = 0; // seconds on the clock
};

/// The visible messages of the window.
class Messages {
public:
    /// Creates a list. It forwards notes and failures to `tell`.
    Messages(Clock now, std::function<void(const std::string&)> tell) : now_(std::move(now)), tell_(std::move(tell)) {}

    /// Shows the result of a key press for two seconds. It replaces the previous result of a key press. The message is
    /// not forwarded.
    void show(const std::string& text);

    /// Shows a result, such as a saved file, for six seconds.
    void note(const std::string& text);

    /// Shows a failure for fifteen seconds.
    void fail(const std::string& reason);

    /// Removes expired messages. Returns true if there were any.
    bool expire();

    /// Runs `action` and shows its exception as a failure. Returns true if there was no exception.
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
    bool lastIsShown_ = false; // whether the last message is from `show`
};

} // namespace gnomon::viewer
