// A folder for the files of one test.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <system_error>

#include <unistd.h>

namespace gnomon::pipeline {

/// A new folder, which the destructor removes.
class TestFolder {
public:
    TestFolder() {
        static int number = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("gnomon_pipeline_" + std::to_string(::getpid()) + "_" + std::to_string(number++));
        std::filesystem::create_directories(path_);
    }

    ~TestFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;
    TestFolder(TestFolder&&) = delete;
    TestFolder& operator=(TestFolder&&) = delete;

    std::string file(const std::string& name) const { return (path_ / name).string(); }

    std::set<std::string> names() const {
        std::set<std::string> names;
        for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(path_))
            names.insert(entry.path().filename().string());
        return names;
    }

private:
    std::filesystem::path path_;
};

} // namespace gnomon::pipeline
