// Ranges kept on disk, what servers say of them, and files behind the same interface; whole servers are met in
// tests/cli/http_test.py.
#include "core/error.h"
#include "core/file.h"
#include "core/random.h"
#include "hierarchy/source/file_source.h"
#include "hierarchy/source/open_source.h"
#include "hierarchy/source/range_cache.h"
#include "hierarchy/source/range_request.h"
#include "hierarchy/source/source.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace gnomon::hierarchy {
namespace {

namespace fs = std::filesystem;

std::vector<std::byte> randomBytes(Random& random, std::size_t size) {
    std::vector<std::byte> bytes(size);
    for (std::byte& byte : bytes)
        byte = static_cast<std::byte>(random.below(256));
    return bytes;
}

std::uint64_t bytesIn(const std::string& folder) {
    std::uint64_t total = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) total += entry.file_size();
    return total;
}

TEST(PartPlace, TakesWholeRangesAndNothingElse) {
    const auto place = partPlace("bytes 5-9/20");
    ASSERT_TRUE(place);
    EXPECT_EQ(place->first, 5U);
    EXPECT_EQ(place->last, 9U);
    EXPECT_EQ(place->of, 20U);
    EXPECT_TRUE(partPlace("Bytes 0-0/1"));
    EXPECT_TRUE(partPlace("bytes 0-18446744073709551613/18446744073709551614"));
    for (const char* range :
         {"",
          "bytes",
          "bytes */20",
          "bytes 5-9/*",
          "bytes 9-5/20",
          "bytes 5-20/20",
          "bytes 5-9/20 ",
          "bytes 5-9",
          "bytes -5-9/20",
          "bytes +5-9/20",
          "bytes 0x5-9/20",
          "items 5-9/20",
          "bytes 5-9/18446744073709551616",
          "bytes 5-9/99999999999999999999"})
        EXPECT_FALSE(partPlace(range)) << range;
}

TEST(PartHeader, KeepsTheLastAnswerOfARedirection) {
    PartHeader header;
    for (const char* line :
         {"HTTP/1.1 302 Found\r\n", "ETag: \"old\"\r\n", "Content-Encoding: gzip\r\n", "\r\n", "HTTP/2 206\r\n"})
        header.take(line);
    header.take("eTaG:  \"a:b\" \r\n");
    header.take("LAST-MODIFIED: now\r\n");
    header.take("Content-Range:bytes 0-1/2\r\n");
    header.take("no colon\r\n");
    header.take(":\r\n");
    EXPECT_EQ(header.encoding, "");
    EXPECT_EQ(header.identity.tag, "\"a:b\"");
    EXPECT_EQ(header.identity.modified, "now");
    EXPECT_EQ(header.range, "bytes 0-1/2");
}

TEST(Addresses, AreToldFromPaths) {
    for (const char* name : {"http://h/m.gnm", "https://h", "HTTPS://h/m"})
        EXPECT_TRUE(isAddress(name)) << name;
    for (const char* name : {"", "http", "http:/h", "ftp://h/m", "./http://h", "models/a.gnm", "httpx://h"})
        EXPECT_FALSE(isAddress(name)) << name;
}

TEST(RangeCache, IsAMapWhileThereIsRoom) {
    Random random(1);
    const std::string folder = testing::TempDir() + "ranges";
    const RangeCache first(folder, mebibytes(64), "first");
    const RangeCache second(folder, mebibytes(64), "second");
    std::map<std::pair<bool, std::pair<std::uint64_t, std::uint64_t>>, std::vector<std::byte>> twin;
    for (int step = 0; step < 400; ++step) {
        const bool isFirst = random.below(2) == 0;
        const RangeCache& cache = isFirst ? first : second;
        const std::uint64_t offset = random.below(8);
        const std::uint64_t size = random.below(5);
        if (random.below(2) == 0) {
            const std::vector<std::byte> bytes = randomBytes(random, size);
            cache.put(offset, bytes);
            twin[{isFirst, {offset, size}}] = bytes;
        }
        std::vector<std::byte> out(size);
        const auto kept = twin.find({isFirst, {offset, size}});
        ASSERT_EQ(cache.get(offset, out), kept != twin.end());
        if (kept != twin.end()) {
            ASSERT_EQ(out, kept->second);
        }
    }
}

TEST(RangeCache, ForgetsWhatWasNotUsedForLongest) {
    Random random(2);
    const std::string folder = testing::TempDir() + "capped";
    const Bytes cap{64 << 10U};
    const RangeCache cache(folder, cap, "content");
    std::vector<std::byte> out(4000);
    for (std::uint64_t offset = 0; offset < 60; ++offset) {
        cache.put(offset, randomBytes(random, 4000));
        EXPECT_LE(bytesIn(folder), cap.count);
        EXPECT_TRUE(cache.get(offset, out));
        EXPECT_TRUE(cache.get(0, out)) << "it is used all the time";
        fs::last_write_time(folder, fs::file_time_type::clock::now());
        std::this_thread::sleep_for(std::chrono::milliseconds(2)); // times of files are coarse
    }
    EXPECT_GT(bytesIn(folder), cap.count / 2);
    cache.put(100, randomBytes(random, cap.count));
    EXPECT_TRUE(cache.get(59, out)) << "what is larger than the cap takes nobody's place";
}

TEST(RangeCache, RemovesNothingButItsOwnFilesAndFollowsNoLink) {
    Random random(4);
    const std::string folder = testing::TempDir() + "mixed";
    const std::string photos = testing::TempDir() + "photos";
    const std::string digits(32, 'a');
    const auto fill = [&](const Bytes& cap) {
        const RangeCache cache(folder, cap, "content");
        for (std::uint64_t offset = 0; offset < 30; ++offset)
            cache.put(offset, randomBytes(random, 4000));
    };
    fill({64 << 10U});
    fs::create_directories(photos);
    fs::create_directories(folder + "/" + digits);
    fs::create_directories(folder + "/album");
    fs::create_directory_symlink(photos, folder + "/" + std::string(32, 'b'));
    const std::vector<std::string> theirs = {
        photos + "/1-2",
        folder + "/1.jpg",
        folder + "/1-2",
        folder + "/album/1-2",
        folder + "/" + digits + "/1-2.jpg",
        folder + "/" + digits + "/1-2.3.partial",
        folder + "/" + digits + "/-2"};
    for (const std::string& path : theirs)
        writeTextFile(path, std::string(100'000, 'x'));
    const std::string left = folder + "/" + digits + "/1-2.3.4.partial";
    writeTextFile(left, std::string(100'000, 'x'));
    fill({64 << 10U});
    for (const std::string& path : theirs)
        EXPECT_TRUE(fs::exists(path)) << path;
    EXPECT_FALSE(fs::exists(left)) << "by a process that was killed";

    fs::remove_all(folder);
    fs::create_directory_symlink(photos, folder);
    fill({64 << 10U});
    std::vector<std::byte> out(4000);
    EXPECT_FALSE(RangeCache(folder, mebibytes(1), "content").get(29, out)) << "through a link nothing is kept";
    EXPECT_TRUE(fs::exists(photos + "/1-2"));
    EXPECT_EQ(std::distance(fs::directory_iterator(photos), fs::directory_iterator()), 1);
}

TEST(RangeCache, IsSharedByThreadsAndProcesses) {
    const std::string folder = testing::TempDir() + "shared";
    const Bytes cap{40 << 10U};
    std::vector<std::thread> threads;
    for (std::uint64_t seed = 0; seed < 4; ++seed)
        threads.emplace_back([&, seed] {
            const RangeCache cache(folder, cap, "content"); // as another process would
            Random random(seed);
            for (int step = 0; step < 100; ++step) {
                const std::uint64_t offset = random.below(20);
                cache.put(offset, std::vector<std::byte>(3000, static_cast<std::byte>(offset)));
                std::vector<std::byte> out(3000);
                const std::uint64_t other = random.below(20);
                if (cache.get(other, out)) {
                    ASSERT_EQ(out, std::vector<std::byte>(3000, static_cast<std::byte>(other)));
                }
            }
        });
    for (std::thread& thread : threads)
        thread.join();
}

TEST(RangeCache, TakesNothingDamagedAndNeedsNoDisk) {
    Random random(3);
    const std::string folder = testing::TempDir() + "damaged";
    const RangeCache cache(folder, mebibytes(1), "content");
    const std::vector<std::byte> bytes = randomBytes(random, 1000);
    std::vector<std::byte> out(1000);
    for (int trial = 0; trial < 20; ++trial) {
        cache.put(7, bytes);
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            if (!entry.is_regular_file()) continue;
            File file(entry.path().string(), File::Mode::Update);
            const std::uint64_t place = random.below(file.size());
            std::array<std::byte, 1> byte{};
            file.readAt(place, byte);
            byte[0] ^= std::byte{1};
            file.writeAt(place, byte);
            if (trial % 2 == 1) file.resize(place);
        }
        EXPECT_FALSE(cache.get(7, out));
    }
    writeTextFile(testing::TempDir() + "file", "not a folder");
    const RangeCache nowhere(testing::TempDir() + "file", mebibytes(1), "content");
    nowhere.put(0, bytes);
    EXPECT_FALSE(nowhere.get(0, out));
}

TEST(FileSource, ReadsAndTellsWhatBecameOfTheFile) {
    const std::string path = testing::TempDir() + "content";
    writeTextFile(path, "0123456789");
    const auto source = openSource(path);
    EXPECT_EQ(source->name(), path);
    EXPECT_EQ(source->size(), 10U);
    EXPECT_FALSE(source->isRemote());
    std::array<std::byte, 3> out{};
    source->readAt(7, out);
    EXPECT_EQ(out[0], std::byte{'7'});
    EXPECT_THROW(source->readAt(8, out), Error);
    EXPECT_FALSE(source->readAnew(0, out));
    const std::string stamp = source->stamp();
    EXPECT_EQ(openSource(path)->stamp(), stamp);
    EXPECT_EQ(source->fate(), Fate::Same);
    fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(5));
    EXPECT_EQ(source->fate(), Fate::Changed);
    EXPECT_NE(openSource(path)->stamp(), stamp);
    fs::remove(path);
    EXPECT_EQ(source->fate(), Fate::Gone);
    EXPECT_THROW(openSource(path), Error);
}

} // namespace
} // namespace gnomon::hierarchy
