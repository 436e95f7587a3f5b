#include "viewer/messages.h"

#include "core/printable.h"

#include <algorithm>

namespace gnomon::viewer {

namespace {

constexpr double kShowSeconds = 2;
constexpr double kNoteSeconds = 6;
constexpr double kFailSeconds = 15;

} // namespace

void Messages::show(const std::string& text) {
    if (lastIsShown_ && !messages_.empty()) messages_.pop_back();
    messages_.push_back({printable(text), false, now_() + kShowSeconds});
    lastIsShown_ = true;
}

void Messages::note(const std::string& text) {
    messages_.push_back({printable(text), false, now_() + kNoteSeconds});
    lastIsShown_ = false;
    tell_(text);
}

void Messages::fail(const std::string& reason) {
    const std::string text = printable(reason);
    // A failure that occurs repeatedly, for example in each frame, is shown as one message.
    const auto same = std::find_if(messages_.begin(), messages_.end(), [&](const Message& message) {
        return message.isError && message.text == text;
    });
    if (same != messages_.end()) {
        same->until = now_() + kFailSeconds;
        return;
    }
    messages_.push_back({text, true, now_() + kFailSeconds});
    lastIsShown_ = false;
    tell_(text);
}

bool Messages::expire() {
    const double now = now_();
    const std::size_t before = messages_.size();
    if (lastIsShown_ && !messages_.empty() && messages_.back().until <= now) lastIsShown_ = false;
    messages_.erase(
        std::remove_if(
            messages_.begin(), messages_.end(), [&](const Message& message) { return message.until <= now; }),
        messages_.end());
    return messages_.size() != before;
}

} // namespace gnomon::viewer
