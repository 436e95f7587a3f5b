// One setting: its name, its help and how its value is read, written, found and changed, whatever its type.
#pragma once

#include "settings/codec.h"
#include "settings/removed_words.h"
#include "settings/settings.h"

#include <algorithm>
#include <any>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::settings {

/// A value of the type of its setting.
using Value = std::any;

/// What kind of value a setting has, for those who offer it: words, on and off, int, std::optional<int>, double,
/// std::array<int, 2>, or anything else.
enum class Kind : std::uint8_t { Words, Switch, Whole, WholeOrAuto, Number, Size, Other };

/// How a window offers a setting.
struct Offer {
    std::string title{}; // empty: it does not
    double least = 0;    // of numbers, and of each side of a size
    double most = 0;
    std::vector<int> steps{}; // of a whole number: those that its key steps through; empty: all
};

/// What is said of a setting.
struct Description {
    std::string name; // "error-pixels"
    std::string form; // of its text, for the help: "T"; empty: its words
    std::string help;
    bool isRepeated = false;    // may be given several times; its text is all of them with semicolons between
    bool isSwept = false;       // a bench takes a list of values
    bool isOfMaps = false;      // it says how shadow maps are, and contradicts shadows without them
    bool changesPicture = true; // else the picture is the same for all its values, but for the time that it takes
    std::string statedAs{};     // under which key a bench states it and a baseline must agree; empty: it does not
    std::string quantity{};     // what errors of the engines call it: "image size"
    Offer offer{};
};

class Setting {
public:
    /// The setting that `codec` reads and writes, `get` finds and `set` changes.
    template <class T, class Get, class Set>
    Setting(Description description, const Codec<T>& codec, Get get, Set set)
        : description_(std::move(description)),
          kind_(kindOf(codec)),
          words_(codec.words),
          parse_([codec](const std::string& option, const std::string& text) {
              return Value(parsed(codec, option, text));
          }),
          write_([codec](const Value& value) { return codec.write(std::any_cast<const T&>(value)); }),
          get_([get](const Settings& settings) { return Value(T(get(settings))); }),
          set_([set](Settings& settings, const Value& value) { set(settings, std::any_cast<const T&>(value)); }) {
        if (description_.form.empty())
            for (const std::string& word : words_)
                description_.form += (description_.form.empty() ? "" : "|") + word;
    }

    const Description& description() const { return description_; }

    const std::string& name() const { return description_.name; }

    Kind kind() const { return kind_; }

    /// All its texts, where they are words of a list.
    const std::vector<std::string>& words() const { return words_; }

    /// "--error-pixels".
    std::string option() const { return "--" + description_.name; }

    /// "error_pixels": in logs and in the names of runs.
    std::string column() const {
        std::string text = description_.name;
        std::replace(text.begin(), text.end(), '-', '_');
        return text;
    }

    /// The value of `text`. Throws UsageError that names `option`, of which there may be others than `option()`.
    Value parse(const std::string& option, const std::string& text) const {
        refuseRemovedWord(this->option(), text);
        return parse_(option, text);
    }

    Value parse(const std::string& text) const { return parse(option(), text); }

    std::string text(const Value& value) const { return write_(value); }

    /// The text of its value in `settings`; empty for what was not given.
    std::string text(const Settings& settings) const { return write_(get_(settings)); }

    Value value(const Settings& settings) const { return get_(settings); }

    void set(Settings& settings, const Value& value) const { set_(settings, value); }

    bool isDefault(const Settings& settings) const { return text(settings) == text(Settings()); }

private:
    template <class T>
    static Kind kindOf(const Codec<T>& codec) {
        if (std::is_same_v<T, bool>) return Kind::Switch;
        if (!codec.words.empty()) return Kind::Words;
        if (std::is_same_v<T, int>) return Kind::Whole;
        if (std::is_same_v<T, std::optional<int>>) return Kind::WholeOrAuto;
        if (std::is_same_v<T, double>) return Kind::Number;
        if (std::is_same_v<T, std::array<int, 2>>) return Kind::Size;
        return Kind::Other;
    }

    Description description_;
    Kind kind_;
    std::vector<std::string> words_;
    std::function<Value(const std::string&, const std::string&)> parse_;
    std::function<std::string(const Value&)> write_;
    std::function<Value(const Settings&)> get_;
    std::function<void(Settings&, const Value&)> set_;
};

} // namespace gnomon::settings
