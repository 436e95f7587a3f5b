// Short messages that the window shows for some seconds. Some of them are also forwarded to a log.
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::viewer {

/// A clock: returns the seconds since an arbitrary moment.
using Clock = std::function<double()>;

/// A message of one line of visible characters, with the time when it disappears.
struct Message {
    std::string text;
    bool isError = false;
    double until = 0; // seconds on the clock
};

/// The list of messages that the window shows now.
class Messages {
public:
    /// Creates an empty list of messages. It forwards notes and failures to `tell`.
    Messages(Clock now, std::function<void(const std::string&)> tell) : now_(std::move(now)), tell_(std::move(tell)) {}

    /// Shows `text`, the result of a key press, for two seconds. It replaces the result of the previous key press and
    /// is not forwarded to the log.
    void show(const std::string& text);

    /// Shows `text`, a result such as a saved file, for six seconds, and forwards it to the log.
    void note(const std::string& text);

    /// Shows the reason of a failure for fifteen seconds, and forwards it to the log.
    void fail(const std::string& reason);

    /// Removes messages whose time is over. Returns true if there were any.
    bool expire();

    /// Runs `action`. If it throws an exception, shows the message as a failure and returns false. Otherwise returns
    /// true.
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
