#include "preprocess/pipeline/fingerprint.h"

#include "core/file.h"
#include "core/random.h"
#include "hierarchy/file_layout.h"

#include <algorithm>
#include <filesystem>

namespace gnomon::preprocess {

std::string fingerprintOf(const std::vector<std::string>& paths) {
    constexpr std::uint64_t kSamples = 64;
    constexpr std::uint64_t kSampleBytes = 4096;
    std::string text;
    for (const std::string& path : paths) {
        const File file(path, File::Mode::Read);
        const std::uint64_t size = file.size();
        const auto changed = std::filesystem::last_write_time(path).time_since_epoch().count();
        std::uint64_t hash = 0;
        std::vector<std::byte> sample(std::min(size, kSampleBytes));
        for (std::uint64_t i = 0; i < kSamples; ++i) {
            const std::uint64_t room = size - sample.size();
            file.readAt(room / (kSamples - 1) * i + room % (kSamples - 1) * i / (kSamples - 1), sample);
            hash = mix64(hash ^ hierarchy::checksum64(sample));
        }
        text += (text.empty() ? "input " : " and ") + std::to_string(size) + " bytes of time " +
                std::to_string(changed) + " with hash " + std::to_string(hash);
    }
    return text;
}

} // namespace gnomon::preprocess
