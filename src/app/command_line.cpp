#include "app/command_line.h"

#include "app/commands.h"
#include "core/units.h"
#include "gl/shader_library.h"
#include "hierarchy/source/access.h"
#include "settings/contradictions.h"
#include "settings/old_names.h"
#include "settings/table.h"

#include <filesystem>

namespace gnomon::app {

namespace {

/// Returns a validator for a folder that contains a file for each built-in shader, so that each backend finds its
/// shaders there.
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

/// Returns the placeholder for the value of a setting in the format of CLI11. If the setting has a list of words, the
/// placeholder contains them: "KIND:{off,maps}".
std::string typeOf(const settings::Setting& setting) {
    std::string type = setting.description().form;
    for (const std::string& word : setting.words())
        type += (&word == &setting.words().front() ? ":{" : ",") + word;
    return setting.words().empty() ? type : type + "}";
}

} // namespace

void SettingOptions::addTo(CLI::App& command) {
    const settings::Settings defaults;
    for (const settings::Setting& setting : settings::table()) {
        const settings::Description& description = setting.description();
        // Takes the value as text, because CLI11 would ignore an empty text if it converted the value itself.
        const auto take = [this, &setting](const std::string& text) { texts_[setting.name()] = text; };
        CLI::Option* option =
            command.add_option_function<std::string>(settings::withOldNames(setting.option()), take, description.help);
        if (description.isRepeated) option->join(';');
        option->type_name(typeOf(setting))
            ->default_str(description.usually.empty() ? setting.text(defaults) : description.usually);
    }
    command.get_option(settings::named("shaders").option())->check(shaderFolder());
}

void SettingOptions::requireMapsFor(const std::string& option) const {
    settings::requireMapsFor(option, texts_);
}

settings::Settings SettingOptions::settings() const {
    settings::Settings result = parsed();
    settings::requireSound(result);
    settings::readCamera(result);
    return result;
}

settings::Settings SettingOptions::parsed() const {
    return settings::settingsOf(texts_);
}

settings::Settings SettingOptions::fixedSettings() const {
    return settings::settingsOf(texts_, false);
}

std::vector<settings::Axis> SettingOptions::axes(const std::optional<std::string>& shadowMaps) const {
    const settings::Setting& slices = settings::named("z-partitions");
    const settings::Setting& faces = settings::named("face-partitions");
    if (shadowMaps) requireMapsFor("--shadow-maps");
    const auto facesText = texts_.find(faces.name());
    if (shadowMaps && facesText != texts_.end() && facesText->second != faces.text(settings::Settings()))
        throw settings::UsageError{
            "--shadow-maps",
            "--shadow-maps and " + faces.option() + " " + facesText->second +
                " contradict each other: --shadow-maps has no face partitions"};
    std::vector<settings::Axis> axes;
    for (const settings::Setting& setting : settings::table()) {
        const auto text = texts_.find(setting.name());
        if (shadowMaps && &setting == &slices)
            axes.push_back(settings::parseAxis(setting, "--shadow-maps", *shadowMaps));
        else if (setting.description().isSwept && text != texts_.end())
            axes.push_back(settings::parseAxis(setting, setting.option(), text->second));
    }
    return axes;
}

void addColorOptions(CLI::App& command, settings::ValueColorWords& words) {
    command.add_option("--color-by", words.by, "Colour by vertex, height, slope, error or a field")
        ->type_name("VALUE|" + enumerated(settings::kColorBys, "|", "|"))
        ->default_str("none");
    command.add_option("--colormap", words.map, "Colours of --color-by: " + enumerated(plan::kColorMaps, ", ", " or "))
        ->type_name("NAME|" + enumerated(plan::kColorMaps, "|", "|"))
        ->default_str("viridis");
    command.add_option("--color-range", words.range, "Values at the two ends of --colormap")
        ->type_name("LO,HI")
        ->default_str("all values of the model");
}

void requireNoWindow(const settings::Settings& settings) {
    if (settings.backend == settings::Backend::Window)
        throw settings::UsageError{"--backend", "--backend window works only with gnomon view"};
}

CLI::Validator seedText() {
    return {
        [](std::string& text) {
            return settings::seed().read(text) ? std::string()
                                               : "expected " + settings::seed().expected + ", found '" + text + "'";
        },
        "SEED"};
}

void addServerOptions(CLI::App& command) {
    hierarchy::Access& access = hierarchy::commonAccess();
    command
        .add_option(
            "--cacert",
            access.authorityFile,
            "Certificates to trust for https:// models, in place of those of the system")
        ->type_name("FILE.pem")
        ->check(CLI::ExistingFile);
    command
        .add_option_function<std::string>(
            "--http-cache",
            [&access](const std::string& text) { access.cache = *parseBytes(text); },
            "Max size of the disk cache for models on servers; 0 turns the cache off")
        ->check(memorySize())
        ->type_name("SIZE")
        ->default_str("1G");
}

void addModel(CLI::App& command, std::string& model) {
    command.add_option("MODEL", model, "A .gnm file, or its http:// or https:// address")->required();
    addServerOptions(command);
}

CLI::Validator memorySize() {
    return {
        [](std::string& text) {
            return parseBytes(text) ? std::string() : "expected a memory size such as 512M or 2G, found '" + text + "'";
        },
        "SIZE"};
}

} // namespace gnomon::app
