#include "scripted_server.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

namespace gnomon::tests {

namespace {

/// The question that `header` asks.
RangeQuestion questionOf(const std::string& header) {
    RangeQuestion question;
    const std::size_t path = header.find(' ') + 1;
    question.path = header.substr(path, header.find(' ', path) - path);
    const std::size_t range = header.find("Range: bytes=");
    unsigned long long first = 0;
    unsigned long long last = 0;
    if (range != std::string::npos)
        question.isOfRange = std::sscanf(header.c_str() + range, "Range: bytes=%llu-%llu", &first, &last) == 2;
    question.first = first;
    question.last = last;
    return question;
}

bool sendAll(int connection, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(connection, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

} // namespace

RawAnswer partOf(
    const std::string& content,
    const RangeQuestion& question,
    const std::vector<std::string>& changes,
    const std::string* body) {
    if (question.first >= content.size()) return statusOnly(416);
    const std::uint64_t last = std::min<std::uint64_t>(question.last, content.size() - 1);
    const std::string part = body != nullptr ? *body : content.substr(question.first, last - question.first + 1);
    std::vector<std::string> lines = {
        "Content-Range: bytes " + std::to_string(question.first) + "-" + std::to_string(last) + "/" +
            std::to_string(content.size()),
        "Content-Length: " + std::to_string(part.size()),
        "ETag: \"a\"",
        "Last-Modified: Mon, 23 Nov 2026 17:00:00 GMT"};
    for (const std::string& change : changes) {
        const std::string name = change.substr(0, change.find(':') + 1);
        std::erase_if(lines, [&](const std::string& line) { return line.starts_with(name); });
        if (change.size() > name.size()) lines.push_back(change);
    }
    RawAnswer answer{"HTTP/1.1 206 Partial Content\r\n"};
    for (const std::string& line : lines)
        answer.bytes += line + "\r\n";
    answer.bytes += "\r\n" + part;
    return answer;
}

RawAnswer statusOnly(int status, const std::string& header) {
    return {"HTTP/1.1 " + std::to_string(status) + " So\r\n" + header + "Content-Length: 0\r\n\r\n"};
}

ScriptedServer::ScriptedServer(std::function<RawAnswer(const RangeQuestion&)> answer, std::uint16_t port)
    : answer_(std::move(answer)), listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const int yes = 1;
    ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(place);
    auto* address = reinterpret_cast<sockaddr*>(&place);
    if (::bind(listener_, address, size) != 0 || ::listen(listener_, 64) != 0 ||
        ::getsockname(listener_, address, &size) != 0)
        throw std::runtime_error("no port on this machine");
    port_ = ntohs(place.sin_port);
    acceptor_ = std::thread([this] { accept(); });
}

ScriptedServer::~ScriptedServer() {
    ::shutdown(listener_, SHUT_RDWR);
    acceptor_.join();
    {
        const std::lock_guard lock(mutex_);
        for (const int connection : open_)
            ::shutdown(connection, SHUT_RDWR);
    }
    for (std::thread& thread : threads_)
        thread.join();
    for (const int connection : open_)
        ::close(connection);
    ::close(listener_);
}

std::string ScriptedServer::address() const {
    return "http://127.0.0.1:" + std::to_string(port_) + "/model.gnm";
}

void ScriptedServer::accept() {
    for (;;) {
        const int connection = ::accept(listener_, nullptr, nullptr);
        if (connection < 0) return;
        const int yes = 1;
        ::setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
        ++connections_;
        const std::lock_guard lock(mutex_);
        open_.push_back(connection);
        threads_.emplace_back([this, connection] { serve(connection); });
    }
}

void ScriptedServer::serve(int connection) {
    std::string received;
    std::array<char, 4096> buffer{};
    std::uint64_t sent = 0;
    const auto send = [&](std::string_view bytes) {
        const bool isSent = sendAll(connection, bytes);
        sent += bytes.size();
        std::uint64_t max = maxSent_;
        while (max < sent && !maxSent_.compare_exchange_weak(max, sent)) {
        }
        return isSent;
    };
    for (;;) {
        const std::size_t end = received.find("\r\n\r\n");
        if (end == std::string::npos) {
            const ssize_t got = ::recv(connection, buffer.data(), buffer.size(), 0);
            if (got <= 0) return;
            received.append(buffer.data(), static_cast<std::size_t>(got));
            continue;
        }
        RangeQuestion question = questionOf(received.substr(0, end + 4));
        received.erase(0, end + 4);
        question.number = questions_++;
        const RawAnswer answer = answer_(question);
        bool goesOn = send(answer.bytes);
        while (goesOn && answer.repeats)
            goesOn = send(std::string_view(answer.bytes)
                              .substr(answer.bytes.size() - std::min<std::size_t>(answer.bytes.size(), 4096)));
        if (goesOn && !answer.hangsUp) continue;
        ::shutdown(connection, SHUT_RDWR);
        return;
    }
}

} // namespace gnomon::tests
