#include "app/command_line.h"

#include "gl/shader_library.h"
#include "settings/option_text.h"

#include <filesystem>

namespace gnomon::app {

namespace {

/// A folder with all the shaders that are built in: whoever draws, and however, finds his.
CLI::Validator shaderFolder() {
    return {
        [](std::string& folder) {
            std::error_code failure;
            for (const auto& [path, text] : gl::kEmbeddedShaders)
                if (!std::filesystem::is_regular_file(std::filesystem::path(folder) / path, failure))
                    return "expected a folder with " + std::string(path) + ", found none in '" + folder + "'";
            return std::string();
        },
        ""};
}

} // namespace

void addViewOptions(CLI::App& command, settings::ViewOptions& options) {
    const auto add = [&](const char* flag, std::string& value, const char* form, const char* help) {
        return command.add_option(flag, value, help)->group("View and quality")->type_name(form)->capture_default_str();
    };
    for (const settings::PlainOption& plain : settings::plainOptions())
        add(plain.flag, options.*plain.value, plain.form, plain.help);
    for (const settings::SweptOption& swept : settings::sweptOptions()) {
        const bool isWarp = swept.value == &settings::SweptSettings::warp;
        CLI::Option* option = add(swept.flag, options.swept.*swept.value, swept.form, swept.help);
        if (isWarp) option->each([&options](const std::string& /*text*/) { options.isWarpGiven = true; });
    }
    command.get_option("--backend")->check(CLI::IsMember({"auto", "software", "osmesa", "egl", "window"}));
    command.get_option("--shaders")->check(shaderFolder());
}

CLI::Validator seedText() {
    return {
        [](std::string& text) {
            return settings::wholeNumber(text) ? std::string()
                                               : "expected a whole number from 0 to 2^64 - 1, found '" + text + "'";
        },
        "SEED"};
}

} // namespace gnomon::app
