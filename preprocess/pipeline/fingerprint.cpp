#include "preprocess/pipeline/fingerprint.h"

#include "core/file.h"
#include "core/random.h"
#include "hierarchy/file_layout.h"
#include "preprocess/read/input_file.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>

namespace gnomon::pipeline {

namespace {

/// Returns the time of the last change of a file as readable text with nanoseconds.
std::string changeOf(const std::string& path) {
    using std::chrono::nanoseconds;
    const auto time = std::chrono::file_clock::to_sys(std::filesystem::last_write_time(path)).time_since_epoch();
    const auto seconds = std::chrono::floor<std::chrono::seconds>(time);
    const std::time_t whole = seconds.count();
    std::tm utc{};
    ::gmtime_r(&whole, &utc);
    std::array<char, 32> day{};
    std::strftime(day.data(), day.size(), "%Y-%m-%dT%H:%M:%S", &utc);
    std::array<char, 16> rest{};
    const auto parts = static_cast<long long>(std::chrono::duration_cast<nanoseconds>(time - seconds).count());
    std::snprintf(rest.data(), rest.size(), ".%09lldZ", parts);
    return std::string(day.data()) + rest.data();
}

} // namespace

std::string fingerprintOf(const std::vector<std::string>& paths) {
    constexpr std::uint64_t kSamples = 64;
    constexpr std::uint64_t kSampleBytes = 4096;
    std::string text;
    std::uint64_t number = 0;
    for (const std::string& path : paths) {
        read::requireRereadable(path);
        const File file(path, File::Mode::Read);
        const std::uint64_t size = file.size();
        std::uint64_t hash = 0;
        std::vector<std::byte> sample(std::min(size, kSampleBytes));
        for (std::uint64_t i = 0; i < kSamples; ++i) {
            const std::uint64_t room = size - sample.size();
            file.readAt(room / (kSamples - 1) * i + room % (kSamples - 1) * i / (kSamples - 1), sample);
            hash = mix64(hash ^ hierarchy::checksum64(sample));
        }
        const std::string input = "input " + std::to_string(++number);
        if (!text.empty()) text += ", ";
        text.append(input).append(" bytes ").append(std::to_string(size));
        text.append(", ").append(input).append(" changed ").append(changeOf(path));
        text.append(", ").append(input).append(" samples ").append(std::to_string(hash));
    }
    return text;
}

} // namespace gnomon::pipeline
