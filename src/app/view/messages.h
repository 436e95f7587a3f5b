// Short messages that are shown for a while in the window, and told on stderr for whoever reads that later.
#pragma once

#include <string>
#include <vector>

namespace gnomon::app::view {

struct Message {
    std::string text;
    bool isError = false;
    double until = 0; // seconds on the window's clock
};

class Messages {
public:
    /// What a key has set: shown for two seconds and told nowhere else. Replaces the last of its kind.
    void show(const std::string& text, double now);

    /// Something done, such as a file saved: six seconds.
    void note(const std::string& text, double now);

    /// Something that could not be done: fifteen seconds.
    void fail(const std::string& text, double now);

    /// Drops what has been shown long enough; true if anything went.
    bool expire(double now);

    const std::vector<Message>& all() const { return messages_; }

private:
    std::vector<Message> messages_;
    bool lastIsShown_ = false; // the last message is one of `show`
};

} // namespace gnomon::app::view
