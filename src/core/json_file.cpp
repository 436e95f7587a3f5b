#include "core/json_file.h"

#include "core/error.h"
#include "core/file.h"

#include <cmath>
#include <cstdlib>
#include <vector>

namespace gnomon {

namespace {

/// Scans a JSON document before parsing, and checks the limits of json_file.h. The parser reports syntax errors.
class Limits {
public:
    Limits(const std::string& path, const std::string& text) : path_(path), text_(text) {}

    /// Throws Error if the JSON document exceeds a limit of depth, entries or numbers.
    void require() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"')
                skipString();
            else if (c == '-' || (c >= '0' && c <= '9'))
                number();
            else
                mark(c);
        }
    }

private:
    void mark(char c) {
        if (c == '{' || c == '[') {
            if (entries_.size() == kJsonDepth) fail("nested too deep", std::to_string(kJsonDepth) + " levels", "more");
            entries_.push_back(0);
        } else if ((c == '}' || c == ']') && !entries_.empty()) {
            entries_.pop_back();
        } else if (c == ':' && !entries_.empty() && ++entries_.back() > kJsonEntries) {
            fail("an object is too large", std::to_string(kJsonEntries) + " entries", "more");
        }
        ++at_;
    }

    void skipString() {
        for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_)
            if (text_[at_] == '\\') ++at_;
        ++at_;
    }

    void number() {
        constexpr std::size_t kShown = 40;
        const std::size_t end = std::min(text_.find_first_not_of("0123456789+-.eE", at_), text_.size());
        const std::string token = text_.substr(at_, end - at_);
        if (std::isinf(std::strtod(token.c_str(), nullptr)))
            fail("a number is too large", "1.8e308", token.substr(0, kShown) + (token.size() > kShown ? "..." : ""));
        at_ = end;
    }

    [[noreturn]] void fail(const char* what, const std::string& limit, const std::string& found) const {
        throw Error(atByte(path_, at_), what, "at most " + limit, found);
    }

    const std::string& path_;
    const std::string& text_;
    std::size_t at_ = 0;
    std::vector<std::size_t> entries_; // entries so far, per open array or object
};

} // namespace

void requireJsonLimits(const std::string& path, const std::string& text) {
    Limits(path, text).require();
}

nlohmann::ordered_json readJsonFile(const std::string& path) {
    const std::string text = readTextFile(path, {kJsonBytes});
    requireJsonLimits(path, text);
    try {
        return nlohmann::ordered_json::parse(text);
    } catch (const nlohmann::ordered_json::parse_error& error) {
        throw Error(atByte(path, error.byte), "not JSON", "a JSON document", "a syntax error");
    }
}

} // namespace gnomon
