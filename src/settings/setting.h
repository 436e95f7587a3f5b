// Describes one option of any type: its name, its help, and functions that parse, write, get and set its value.
#pragma once

#include "core/limit_error.h"
#include "settings/codec.h"
#include "settings/removed_words.h"
#include "settings/settings.h"

#include <algorithm>
#include <any>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::settings {

/// The value of a setting, stored as the setting's own type.
using Value = std::any;

/// The type of a setting's value: a list of words, bool, int, std::optional<int>, double, std::array<int, 2>, or any
/// other type. It selects the control in the window and the steps of keys.
enum class Kind : std::uint8_t { Words, Switch, Whole, WholeOrAuto, Number, Size, Other };

/// The control with which the user changes a setting in the window.
struct Offer {
    std::string title{};      // empty: the window has no control for it
    double min = 0;           // min of a number, and of each side of a size
    double max = 0;           // max of a number, and of each side of a size
    std::vector<int> steps{}; // values through which the key of a whole number steps; empty: all numbers
};

/// The name, the help and the properties of a setting, which all interfaces share.
struct Description {
    std::string name;             // "error-pixels"
    std::string form;             // placeholder for the value in the help: "T"; empty: the list of words
    std::string help;             // one clause; it explains each word of `form`, unless `form` is the list of words
    std::string usually{};        // default in words, if there is no default value or if the value needs an explanation
    bool isRepeated = false;      // may be given several times; its text joins all values with semicolons
    bool isSwept = false;         // a bench accepts a list of values
    bool isOfMaps = false;        // a property of shadow maps, which contradicts shadows without maps
    bool changesPicture = true;   // if false, all values give the same picture, in different times
    std::string statedAs{};       // key in the results of a bench, which must agree with the baseline; empty: no key
    std::optional<Limit> limit{}; // the limit of a LimitError that this option sets
    Offer offer{};
};

/// An option of any type, with functions to read and change its value in Settings.
class Setting {
public:
    /// Creates a setting. `codec` parses and writes its value as text, `get` reads the value from Settings, and `set`
    /// stores it there.
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

    /// Returns all valid texts of a setting whose kind is Words or Switch. Returns an empty list for other kinds.
    const std::vector<std::string>& words() const { return words_; }

    /// Returns the option: "--error-pixels".
    std::string option() const { return "--" + description_.name; }

    /// Returns the column name of the setting in logs and in names of runs, such as "error_pixels".
    std::string column() const {
        std::string text = description_.name;
        std::replace(text.begin(), text.end(), '-', '_');
        return text;
    }

    /// Parses `text` as a value of this setting. Throws UsageError that names `option` if the text is invalid. `option`
    /// can differ from `option()`, because several options can set the same setting.
    Value parse(const std::string& option, const std::string& text) const {
        refuseRemovedWord(this->option(), text);
        return parse_(option, text);
    }

    Value parse(const std::string& text) const { return parse(option(), text); }

    std::string text(const Value& value) const { return write_(value); }

    /// Returns the value of this setting in `settings` as text. The text is empty for an option that the user did not
    /// give.
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
