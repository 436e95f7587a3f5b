// A log whose file may end anywhere: what was whole comes back, what was not is cut off.
#include "core/file.h"
#include "core/random.h"
#include "preprocess/scratch/record_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include <unistd.h>

namespace gnomon::scratch {
namespace {

using Record = std::vector<std::byte>;

class Log : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(path); }

    std::string path = testing::TempDir() + "gnomon_record_log_" + std::to_string(::getpid());
};

std::vector<Record> someRecords() {
    Random random(1);
    std::vector<Record> records;
    for (const std::size_t size : {0U, 1U, 15U, 16U, 17U, 300U}) {
        Record& record = records.emplace_back(size);
        for (std::byte& byte : record)
            byte = static_cast<std::byte>(random.bits());
    }
    return records;
}

void write(const std::string& path, const std::vector<Record>& records) {
    RecordLog log = RecordLog::create(path);
    for (const Record& record : records)
        log.append(record);
}

TEST_F(Log, ComesBackInOrderAndGoesOn) {
    const std::vector<Record> records = someRecords();
    write(path, records);
    std::optional<RecordLog> log = RecordLog::reopen(path);
    ASSERT_TRUE(log);
    EXPECT_EQ(log->records(), records);
    EXPECT_EQ(log->bytes(), std::filesystem::file_size(path));
    log->append(records[1]);
    EXPECT_EQ(log->records(), records) << "what reopen found";
    std::vector<Record> more = records;
    more.push_back(records[1]);
    EXPECT_EQ(RecordLog::reopen(path)->records(), more);
}

TEST_F(Log, ThatIsNotThereIsNone) {
    EXPECT_FALSE(RecordLog::reopen(path));
    writeTextFile(path, "");
    const std::optional<RecordLog> empty = RecordLog::reopen(path);
    ASSERT_TRUE(empty) << "an empty file is a log without records";
    EXPECT_TRUE(empty->records().empty());
}

TEST_F(Log, CreatingOneEmptiesWhatWasThere) {
    write(path, someRecords());
    { RecordLog::create(path); }
    EXPECT_TRUE(RecordLog::reopen(path)->records().empty());
}

TEST_F(Log, CutAnywhereItKeepsWhatWasWholeAndCutsTheRest) {
    const std::vector<Record> records = someRecords();
    write(path, records);
    const std::string whole = readTextFile(path);
    std::vector<std::size_t> ends{0};
    for (const Record& record : records)
        ends.push_back(ends.back() + 16 + record.size());
    ASSERT_EQ(ends.back(), whole.size());
    for (std::size_t cut = 0; cut <= whole.size(); cut += cut < 100 ? 1 : 37) {
        writeTextFile(path, whole.substr(0, cut));
        const std::optional<RecordLog> log = RecordLog::reopen(path);
        ASSERT_TRUE(log);
        const auto kept = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), cut) - ends.begin() - 1);
        ASSERT_EQ(
            log->records(), std::vector<Record>(records.begin(), records.begin() + static_cast<std::ptrdiff_t>(kept)));
        EXPECT_EQ(std::filesystem::file_size(path), ends[kept]);
    }
}

TEST_F(Log, ADamagedRecordEndsIt) {
    const std::vector<Record> records = someRecords();
    write(path, records);
    const std::string whole = readTextFile(path);
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        std::string bad = whole;
        const std::size_t place = random.below(bad.size());
        bad[place] = static_cast<char>(bad[place] ^ static_cast<char>(1 + random.below(255)));
        writeTextFile(path, bad);
        const std::vector<Record> kept = RecordLog::reopen(path)->records();
        ASSERT_LT(kept.size(), records.size());
        EXPECT_TRUE(std::equal(kept.begin(), kept.end(), records.begin()));
        std::size_t end = 0;
        for (const Record& record : kept)
            end += 16 + record.size();
        EXPECT_LE(end, place) << "all before the damage is kept, and no more";
        EXPECT_GT(end + 16 + records[kept.size()].size(), place);
    }
}

TEST_F(Log, ALengthThatLiesAsksForNoMemory) {
    std::string lie(16, '\xff');
    writeTextFile(path, lie);
    EXPECT_TRUE(RecordLog::reopen(path)->records().empty());
}

} // namespace
} // namespace gnomon::scratch
