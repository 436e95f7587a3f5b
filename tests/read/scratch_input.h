// A test fixture that reads small files, one after the other, and removes them at its end.
#pragma once

#include "preprocess/read/input_file.h"
#include "preprocess/read/ply/ply_header.h"
#include "tests/read/collect.h"

#include <array>
#include <optional>

#include <unistd.h>

namespace gnomon::read {

/// All types of PLY values.
inline constexpr std::array kTypes = {
    PlyType::Int8,
    PlyType::Uint8,
    PlyType::Int16,
    PlyType::Uint16,
    PlyType::Int32,
    PlyType::Uint32,
    PlyType::Float32,
    PlyType::Float64};

class ScratchInput : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(path); }

    /// Returns a file with the content `text`, open until the next call.
    const InputFile& fileOf(const std::string& text) {
        writeScratch(path, text);
        opened_.emplace(path);
        return *opened_;
    }

    const std::string path = testing::TempDir() + "gnomon_read_" +
                             testing::UnitTest::GetInstance()->current_test_info()->name() + std::to_string(::getpid());

private:
    std::optional<InputFile> opened_;
};

} // namespace gnomon::read
