// The table of the help has a place for each option of each command, and each text names the words of its option.
#include "app/commands.h"
#include "app/help_text.h"
#include "manual/command_words.h"
#include "settings/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

namespace gnomon::app {
namespace {

/// The words of all commands of `gnomon`.
manual::CommandWords allWords() {
    CLI::App program("", "gnomon");
    program.set_help_flag("-h,--help", "");
    program.set_help_all_flag("--help-all", "");
    for (const auto& add :
         {addMakeCommand,
          addInfoCommand,
          addVerifyCommand,
          addExportCommand,
          addPathCommand,
          addRenderCommand,
          addMeasureCommand,
          addExplainCommand,
          addBenchCommand,
          addViewCommand,
          addTheoryCommand})
        add(program);
    addBuildCommand(program);
    addSunCommand(program);
    return manual::commandWords(program);
}

void visit(const manual::CommandWords& command, const std::function<void(const manual::CommandWords&)>& action) {
    action(command);
    for (const manual::CommandWords& below : command.commands)
        visit(below, action);
}

std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

TEST(Help, HasNoRowWithoutAnOption) {
    std::set<std::size_t> used;
    visit(allWords(), [&](const manual::CommandWords& command) {
        for (const manual::OptionWords& option : command.options)
            used.insert(option.place.rank);
    });
    for (std::size_t row = 0; row < settings::helpTable().size(); ++row) {
        const bool isOfProgram = settings::helpTable()[row].option == "version";
        EXPECT_TRUE(isOfProgram || used.contains(row)) << settings::helpTable()[row].option;
    }
}

TEST(Help, ShowsEachSettingOnceInTheHelpOfAllOptions) {
    const manual::CommandWords words = allWords();
    for (const char* const command : {"render", "view", "explain", "bench", "measure"}) {
        manual::CommandWords withoutNotes = manual::commandAt(words, {command});
        withoutNotes.notes.clear();
        const std::string text = helpText(withoutNotes, command, HelpDetail::All);
        for (const settings::Setting& setting : settings::table())
            EXPECT_EQ(occurrences(text, "\n  " + setting.option() + " "), 1U) << command << " " << setting.option();
    }
}

TEST(Help, NamesEachWordOfAnOption) {
    visit(allWords(), [](const manual::CommandWords& command) {
        for (const manual::OptionWords& option : command.options) {
            manual::CommandWords alone;
            alone.options = {option};
            const std::string text = helpText(alone, "", HelpDetail::All);
            for (const std::string& choice : option.choices)
                EXPECT_NE(text.find(choice), std::string::npos)
                    << manual::joinedPath(command, "gnomon", " ") << " " << option.names.back() << " " << choice;
        }
    });
}

TEST(Help, HasAPlaceholderForEachValue) {
    visit(allWords(), [](const manual::CommandWords& command) {
        for (const manual::OptionWords& option : command.options)
            for (const char* const type : {"TEXT", "INT", "UINT", "FLOAT", "VALUE"})
                EXPECT_NE(option.value, type) << manual::joinedPath(command, "gnomon", " ") << option.names.back();
    });
}

} // namespace
} // namespace gnomon::app
