// What is read of a server is what lies there, whatever the server does meanwhile, or an error that says what it did.
#include "core/error.h"
#include "core/random.h"
#include "core/stopwatch.h"
#include "hierarchy/source/access.h"
#include "hierarchy/source/http_source.h"
#include "hierarchy/source/open_source.h"
#include "scripted_server.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::hierarchy {
namespace {

using tests::partOf;
using tests::RangeQuestion;
using tests::RawAnswer;
using tests::ScriptedServer;
using tests::statusOnly;

std::string randomContent(std::uint64_t seed, std::size_t size) {
    Random random(seed);
    std::string content(size, ' ');
    for (char& letter : content)
        letter = static_cast<char>(random.below(256));
    return content;
}

/// Nothing is kept, and who says nothing for a moment has said nothing.
Access hasty() {
    Access access;
    access.cache = {0};
    access.retryTime = std::chrono::milliseconds(0);
    return access;
}

Access patient(std::chrono::milliseconds retryTime = std::chrono::milliseconds(20'000)) {
    Access access = hasty();
    access.retryTime = retryTime;
    return access;
}

std::string readText(const Source& source, std::uint64_t offset, std::size_t size) {
    std::string text(size, ' ');
    source.readAt(offset, std::as_writable_bytes(std::span(text)));
    return text;
}

/// What reading `size` bytes from `offset` of a source that `answer` serves says; empty if it succeeds with the right
/// bytes of `content`.
std::string saidOf(
    const std::string& content,
    const std::function<RawAnswer(const RangeQuestion&)>& answer,
    std::uint64_t offset = 5000,
    std::size_t size = 3000) {
    const ScriptedServer server(answer);
    try {
        const HttpSource source(server.address(), hasty());
        EXPECT_EQ(readText(source, offset, size), content.substr(offset, size));
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(HttpSource, ReadsWhatLiesThereOverFewConnections) {
    const std::string content = randomContent(1, 300'000);
    const ScriptedServer server([&](const RangeQuestion& question) { return partOf(content, question); });
    const HttpSource source(server.address(), hasty());
    EXPECT_EQ(source.size(), content.size());
    EXPECT_EQ(source.name(), server.address());
    EXPECT_TRUE(source.isRemote());
    Random random(2);
    for (int trial = 0; trial < 200; ++trial) {
        const std::uint64_t offset = random.below(content.size());
        const std::uint64_t size = random.below(std::min<std::uint64_t>(content.size() - offset, 40'000)) + 1;
        ASSERT_EQ(readText(source, offset, size), content.substr(offset, size)) << offset << " " << size;
    }
    EXPECT_EQ(server.connections(), 1U) << "one thread needs one, and keeps it";
    EXPECT_EQ(readText(source, content.size(), 0), "");
    EXPECT_THROW(readText(source, content.size(), 1), Error);
    EXPECT_THROW(readText(source, content.size() - 1, 2), Error);
    EXPECT_THROW(readText(source, ~std::uint64_t{0}, 2), Error);
}

TEST(HttpSource, AsksForTheStartAndTheEndOnce) {
    const std::string content = randomContent(3, 300'000);
    const ScriptedServer server([&](const RangeQuestion& question) { return partOf(content, question); });
    const HttpSource source(server.address(), hasty());
    for (std::uint64_t offset = 0; offset < 1000; offset += 100)
        EXPECT_EQ(readText(source, offset, 20), content.substr(offset, 20));
    EXPECT_EQ(server.questions(), 1U);
    for (std::uint64_t offset = content.size() - 60'000; offset < content.size(); offset += 5000)
        EXPECT_EQ(readText(source, offset, 3000), content.substr(offset, 3000));
    EXPECT_EQ(server.questions(), 2U);
}

TEST(HttpSource, ReadsFilesOfAnySize) {
    for (const std::size_t size : {1U, 100U, 1023U, 1024U, 1025U, 65'535U, 65'536U, 66'000U, 67'000U}) {
        const std::string content = randomContent(size, size);
        const ScriptedServer server([&](const RangeQuestion& question) { return partOf(content, question); });
        const HttpSource source(server.address(), hasty());
        ASSERT_EQ(source.size(), size);
        EXPECT_EQ(readText(source, 0, size), content);
        EXPECT_EQ(readText(source, size / 2, size - size / 2), content.substr(size / 2));
    }
    EXPECT_NE(
        saidOf("", [](const RangeQuestion& question) { return partOf("", question); }).find("empty"),
        std::string::npos);
}

/// One of the faults that pass, or the true answer.
RawAnswer faulty(const std::string& content, const RangeQuestion& question, Random& random) {
    RawAnswer answer = partOf(content, question);
    switch (random.below(20)) {
    case 0:
        return statusOnly(503);
    case 1:
        return statusOnly(429, "Retry-After: 1\r\n");
    case 2:
        answer.bytes.resize(random.below(answer.bytes.size()));
        answer.hangsUp = true;
        return answer;
    case 3:
        return {"", true};
    case 4:
        return {"no header at all\r\n\r\n", true};
    default:
        return answer;
    }
}

TEST(HttpSource, ReadsTheSameOfAServerThatFailsNowAndThen) {
    const std::string content = randomContent(4, 200'000);
    std::mutex mutex;
    Random faults(5);
    const ScriptedServer server([&](const RangeQuestion& question) {
        const std::lock_guard lock(mutex);
        return question.number == 0 ? partOf(content, question) : faulty(content, question, faults);
    });
    const HttpSource source(server.address(), patient());
    std::vector<std::thread> threads;
    for (std::uint64_t seed = 0; seed < 8; ++seed)
        threads.emplace_back([&, seed] {
            Random random(seed);
            for (int trial = 0; trial < 4; ++trial) {
                const std::uint64_t offset = random.below(100'000);
                const std::uint64_t size = 1 + random.below(40'000);
                EXPECT_EQ(readText(source, offset, size), content.substr(offset, size));
            }
        });
    for (std::thread& thread : threads)
        thread.join();
}

TEST(HttpSource, TakesShortPartsAndGoesOnBehindThem) {
    const std::string content = randomContent(6, 200'000);
    const auto capped = [&](RangeQuestion question) {
        question.last = std::min(question.last, question.first + 20'000 - 1);
        return partOf(content, question);
    };
    EXPECT_EQ(saidOf(content, capped, 2000, 100'000), "");
    const auto crumbs = [&](RangeQuestion question) {
        if (question.number > 0) question.last = question.first + 99;
        return partOf(content, question);
    };
    EXPECT_NE(saidOf(content, crumbs).find("crumbs"), std::string::npos);
}

TEST(HttpSource, SaysWhatAServerDoesThatIsNotTrue) {
    const std::string content = randomContent(7, 200'000);

    struct Case {
        std::vector<std::string> changes;
        std::string said;
    };

    const std::vector<Case> cases = {
        {{"Content-Range: bytes 5001-8000/200000"}, "another range"},
        {{"Content-Range: bytes 4999-7998/200000"}, "another range"},
        {{"Content-Range: bytes 5000-8000/200000"}, "another range"},
        {{"Content-Range: bytes 5000-7999/*"}, "another range"},
        {{"Content-Range: pages 5000-7999/200000"}, "another range"},
        {{"Content-Range: bytes 5000-18446744073709551615/200000"}, "another range"},
        {{"Content-Range:"}, "another range"},
        {{"Content-Range: bytes 5000-7999/200001"}, "changed on the server"},
        {{"ETag: \"b\""}, "changed on the server"},
        {{"ETag:"}, "changed on the server"},
        {{"Last-Modified: Mon, 23 Nov 2026 17:00:01 GMT"}, "changed on the server"},
        {{"Content-Encoding: gzip"}, "compresses its answer"},
        {{"Content-Encoding: identity"}, ""},
        {{"X-Long: " + std::string(80'000, 'x')}, "header does not end"},
    };
    for (const Case& each : cases) {
        const auto answer = [&](const RangeQuestion& question) {
            return question.number == 0 ? partOf(content, question) : partOf(content, question, each.changes);
        };
        const std::string said = saidOf(content, answer);
        if (each.said.empty())
            EXPECT_EQ(said, "") << each.changes[0];
        else
            EXPECT_NE(said.find(each.said), std::string::npos) << each.changes[0] << ": " << said;
        EXPECT_EQ(said.find('\n'), std::string::npos);
    }
}

TEST(HttpSource, SaysWhatAStatusMeansAtFirstAndLater) {
    const std::string content = randomContent(8, 200'000);

    struct Case {
        int status;
        std::string first;
        std::string later;
    };

    for (const Case& each : std::vector<Case>{
             {200, "gives no byte ranges", "changed on the server"},
             {401, "does not let it be read", "does not let it be read"},
             {403, "does not let it be read", "does not let it be read"},
             {404, "has no such file", "has no such file"},
             {410, "has no such file", "has no such file"},
             {416, "empty", "ends earlier"},
             {400, "refuses", "refuses"},
             {503, "refuses", "refuses"}}) {
        for (const unsigned from : {0U, 1U}) {
            const std::string said = saidOf(content, [&](const RangeQuestion& question) {
                return question.number < from ? partOf(content, question) : statusOnly(each.status);
            });
            EXPECT_NE(said.find(from == 0 ? each.first : each.later), std::string::npos) << each.status << ": " << said;
        }
    }
}

TEST(HttpSource, TellsWhatBecameOfTheContent) {
    const std::string content = randomContent(9, 200'000);
    std::atomic<int> mode{0};
    const ScriptedServer server([&](const RangeQuestion& question) {
        if (mode == 1) return partOf(content, question, {"ETag: \"b\""});
        return mode == 2 ? statusOnly(404) : partOf(content, question);
    });
    const HttpSource source(server.address(), hasty());
    for (const auto& [now, fate] :
         std::vector<std::pair<int, Fate>>{{0, Fate::Same}, {1, Fate::Changed}, {2, Fate::Gone}, {0, Fate::Same}}) {
        mode = now;
        if (fate == Fate::Same)
            EXPECT_EQ(readText(source, 5000, 10), content.substr(5000, 10));
        else
            EXPECT_THROW(readText(source, 5000, 10), Error);
        EXPECT_EQ(source.fate(), fate);
    }
    mode = 1;
    EXPECT_NE(HttpSource(server.address(), hasty()).stamp(), source.stamp());
}

TEST(HttpSource, TakesNoMoreThanItAskedFor) {
    const std::string content = randomContent(10, 200'000);
    std::optional<ScriptedServer> server;
    const std::string filler(1 << 16U, 'x');
    server.emplace([&](const RangeQuestion& question) {
        RawAnswer answer = partOf(content, question, {"Content-Length:"});
        answer.bytes += filler;
        answer.repeats = true;
        return answer;
    });
    EXPECT_THROW(HttpSource(server->address(), hasty()), Error);
    EXPECT_LT(server->maxSent(), std::uint64_t{64} << 20U);
    const auto endlessHeader = [&](const RangeQuestion&) {
        RawAnswer answer{"HTTP/1.1 206 Partial Content\r\n"};
        for (int line = 0; line < 100; ++line)
            answer.bytes += "X-Line: " + std::string(118, 'x') + "\r\n"; // so that 4 KiB are whole lines
        answer.repeats = true;
        return answer;
    };
    EXPECT_NE(saidOf(content, endlessHeader).find("header does not end"), std::string::npos);
    for (const unsigned from : {0U, 1U}) {
        const std::string said = saidOf(content, [&](const RangeQuestion& question) {
            if (question.number < from) return partOf(content, question);
            return RawAnswer{"HTTP/1.1 206 Partial Content\r\nX-Line: " + std::string(5000, 'x'), false, true};
        });
        EXPECT_NE(said.find("header does not end"), std::string::npos) << said;
    }
    EXPECT_NE(
        saidOf(content, [](const RangeQuestion&) { return statusOnly(302, "Location: /again\r\n"); }).find("redirect"),
        std::string::npos);
    EXPECT_NE(
        saidOf(content, [](const RangeQuestion&) { return statusOnly(302, "Location: file:///etc/passwd\r\n"); }), "");
}

TEST(HttpSource, FollowsAServerToWhereItSends) {
    const std::string content = randomContent(11, 200'000);
    const auto answer = [&](const RangeQuestion& question) {
        return question.path == "/there" ? partOf(content, question)
                                         : statusOnly(307, "Location: /there\r\nETag: \"none\"\r\n");
    };
    EXPECT_EQ(saidOf(content, answer), "");
}

TEST(HttpSource, IsGivenUpAtOnceWhereARedirectLeadsToNoServer) {
    const std::string content = randomContent(15, 200'000);
    for (const char* to :
         {"http://127.0.0.1:1/there",
          "https://127.0.0.1:1/there",
          "http://nowhere.invalid/",
          "ftp://127.0.0.1/there",
          "file:///etc/passwd"}) {
        const ScriptedServer server([&](const RangeQuestion& question) {
            return question.number == 0 ? partOf(content, question)
                                        : statusOnly(302, std::string("Location: ") + to + "\r\n");
        });
        const HttpSource source(
            server.address(), patient(std::chrono::hours(1))); // the test ends, so it is not waited for
        EXPECT_THROW(readText(source, 5000, 100), Error) << to;
        EXPECT_EQ(server.questions(), 2U) << to;
    }
}

TEST(HttpSource, IsReadAfterAServerCameBackThatARedirectLeadsTo) {
    const std::string content = randomContent(16, 200'000);
    const auto answer = [&](const RangeQuestion& question) { return partOf(content, question); };
    auto there = std::make_unique<ScriptedServer>(answer);
    const std::uint16_t port = there->port();
    const std::string to = there->address();
    const ScriptedServer server([&](const RangeQuestion&) { return statusOnly(302, "Location: " + to + "\r\n"); });
    const HttpSource source(server.address(), patient());
    there.reset();
    std::thread restart([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        there = std::make_unique<ScriptedServer>(answer, port);
    });
    EXPECT_EQ(readText(source, 9000, 100), content.substr(9000, 100));
    restart.join();
}

TEST(HttpSource, IsReadAfterAServerCameBack) {
    const std::string content = randomContent(12, 200'000);
    const auto answer = [&](const RangeQuestion& question) { return partOf(content, question); };
    auto server = std::make_unique<ScriptedServer>(answer);
    const std::uint16_t port = server->port();
    const HttpSource source(server->address(), patient());
    EXPECT_EQ(readText(source, 5000, 100), content.substr(5000, 100));
    server.reset();
    std::thread restart([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        server = std::make_unique<ScriptedServer>(answer, port);
    });
    EXPECT_EQ(readText(source, 9000, 100), content.substr(9000, 100));
    restart.join();
}

TEST(HttpSource, IsGivenUpWhereItWaits) {
    const std::string content = randomContent(13, 200'000);
    const ScriptedServer server([&](const RangeQuestion& question) {
        return question.number == 0 ? partOf(content, question) : statusOnly(503);
    });
    const HttpSource source(server.address(), patient(std::chrono::hours(1)));
    std::thread stopper([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        source.stop();
    });
    EXPECT_THROW(readText(source, 5000, 100), Error);
    stopper.join();
    EXPECT_THROW(readText(source, 5000, 100), Error) << "and stays so";
}

TEST(HttpSource, KeepsWhatItReadUntilThatIsSaidToBeWrong) {
    std::string content = randomContent(14, 200'000);
    const std::string before = content;
    const ScriptedServer server([&](const RangeQuestion& question) { return partOf(content, question); });
    Access access = hasty();
    access.cache = mebibytes(1);
    access.cacheFolder = testing::TempDir() + "kept";
    const auto opened = [&] { return std::make_unique<HttpSource>(server.address(), access); };
    const std::uint64_t tail = content.size() - 100;
    EXPECT_EQ(readText(*opened(), 5000, 100), before.substr(5000, 100));
    EXPECT_EQ(readText(*opened(), tail, 100), before.substr(tail));
    const unsigned asked = server.questions();
    for (char& letter : content) // which its header does not tell
        letter = static_cast<char>(letter ^ 1);
    const auto source = opened();
    EXPECT_EQ(readText(*source, 5000, 100), before.substr(5000, 100));
    EXPECT_EQ(readText(*source, tail, 100), before.substr(tail));
    EXPECT_EQ(server.questions(), asked + 1);
    for (const std::uint64_t offset : {std::uint64_t{5000}, tail}) {
        std::string text(100, ' ');
        EXPECT_TRUE(source->readAnew(offset, std::as_writable_bytes(std::span(text))));
        EXPECT_EQ(text, content.substr(offset, 100));
        EXPECT_EQ(readText(*opened(), offset, 100), content.substr(offset, 100)) << "and so it is kept";
    }
}

TEST(HttpSource, TellsNoSecretsAndTakesNothingElse) {
    for (const auto& [address, told] : std::vector<std::pair<std::string, std::string>>{
             {"http://user:word@127.0.0.1:1/a/m.gnm?key=word#word", "http://127.0.0.1:1/a/m.gnm"},
             {"http://127.0.0.1:1/a@b", "http://127.0.0.1:1/a@b"},
             {"http://us@er:w@127.0.0.1:1?word", "http://127.0.0.1:1"}}) {
        try {
            const HttpSource source(address, hasty());
            FAIL() << address;
        } catch (const Error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(told + ": ")) << error.what();
            EXPECT_EQ(std::string(error.what()).find("word"), std::string::npos);
        }
    }
    EXPECT_THROW(HttpSource("http://", hasty()), Error);
    EXPECT_THROW(HttpSource("https://[::1", hasty()), Error);
    EXPECT_THROW(HttpSource("file:///etc/passwd", hasty()), Error);
}

} // namespace
} // namespace gnomon::hierarchy
