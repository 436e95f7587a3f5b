#include "preprocess/read/guarded_stream.h"

#include "core/error.h"

namespace gnomon::read {

namespace {

constexpr std::size_t kLongestLine = std::size_t{64} << 20U;

} // namespace

GuardedLines::GuardedLines(const InputFile& file, LineGuard& guard) : file_(file), guard_(guard), stream_(file, 0) {
    guard_.begin();
}

std::string GuardedLines::where() const {
    return atLine(file_.path(), lineNumber_);
}

void GuardedLines::readOut() {
    while (!traits_type::eq_int_type(underflow(), traits_type::eof())) {
    }
}

bool GuardedLines::readLine() {
    line_.clear();
    if (!stream_.fill(1)) return false;
    ++lineNumber_;
    while (stream_.fill(1)) {
        const std::string_view text(reinterpret_cast<const char*>(stream_.data()), stream_.available());
        const std::size_t end = text.find('\n');
        line_ += text.substr(0, end);
        if (line_.size() > kLongestLine) throw Error(where(), "a line of more than 64 MiB");
        stream_.consume(end == std::string_view::npos ? text.size() : end + 1);
        if (end != std::string_view::npos) break;
    }
    return true;
}

GuardedLines::int_type GuardedLines::underflow() {
    while (readLine()) {
        std::optional<std::string> passed = guard_.pass(line_, where());
        if (!passed) continue;
        passed_ = std::move(*passed) + "\n";
        setg(passed_.data(), passed_.data(), passed_.data() + passed_.size());
        return traits_type::to_int_type(passed_.front());
    }
    if (!isEnded_) guard_.end(where());
    isEnded_ = true;
    return traits_type::eof();
}

GuardedLines::pos_type GuardedLines::seekoff(
    off_type offset, std::ios_base::seekdir direction, std::ios_base::openmode mode) {
    return offset == 0 && direction == std::ios_base::beg ? seekpos(0, mode) : pos_type(off_type(-1));
}

GuardedLines::pos_type GuardedLines::seekpos(pos_type position, std::ios_base::openmode /*mode*/) {
    if (position != pos_type(0)) return {off_type(-1)};
    stream_.rewind();
    lineNumber_ = 0;
    isEnded_ = false;
    setg(nullptr, nullptr, nullptr);
    guard_.begin();
    return {0};
}

std::string GuardedBytes::where() const {
    return atByte(stream_.path(), stream_.offset() + static_cast<std::size_t>(gptr() - eback()));
}

GuardedBytes::int_type GuardedBytes::underflow() {
    stream_.consume(given_);
    given_ = 0;
    setg(nullptr, nullptr, nullptr);
    if (!stream_.fill(1)) return traits_type::eof();
    given_ = stream_.available();
    // A streambuf wants a buffer that it could put characters back into; nobody does here.
    auto* begin = const_cast<char*>(reinterpret_cast<const char*>(stream_.data()));
    setg(begin, begin, begin + given_);
    return traits_type::to_int_type(*begin);
}

} // namespace gnomon::read
