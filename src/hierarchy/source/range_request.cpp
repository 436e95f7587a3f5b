#include "hierarchy/source/range_request.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <csignal>
#include <cstring>
#include <ctime>
#include <new>
#include <utility>

#include <curl/curl.h>

namespace gnomon::hierarchy {

namespace {

constexpr std::size_t kMaxHeaderBytes = std::size_t{64} << 10U;
constexpr long kMaxRedirections = 5;
constexpr long kConnectSeconds = 10;
constexpr long kSlowSeconds = 15; // seconds; a transfer that is slower than kSlowRate for this time counts as no answer
constexpr long kSlowRate = 100;   // bytes per second

/// Initialises libcurl only once, because the initialisation is not thread-safe. Returns true if it succeeded.
bool isLibraryReady() {
    static const bool isReady = curl_global_init(CURL_GLOBAL_DEFAULT) == CURLE_OK;
    return isReady;
}

std::string lowered(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
    return result;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

bool takeNumber(std::string_view& text, std::uint64_t& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return true;
}

bool takeText(std::string_view& text, std::string_view start) {
    if (!text.starts_with(start)) return false;
    text.remove_prefix(start.size());
    return true;
}

/// Returns true for errors of libcurl that a retry would not change, for example a server whose identity cannot be
/// verified, or endless redirects.
bool isLasting(CURLcode code) {
    constexpr std::array kCodes = {
        CURLE_PEER_FAILED_VERIFICATION,
        CURLE_TOO_MANY_REDIRECTS,
        CURLE_URL_MALFORMAT,
        CURLE_SSL_CACERT_BADFILE,
        CURLE_SSL_CERTPROBLEM,
        CURLE_SSL_CIPHER,
        CURLE_SSL_ISSUER_ERROR,
        CURLE_SSL_INVALIDCERTSTATUS,
        CURLE_SSL_PINNEDPUBKEYNOTMATCH};
    return std::find(kCodes.begin(), kCodes.end(), code) != kCodes.end();
}

RangeFailure endlessHeader() {
    return {
        Refusal::Lasting, "the server's header does not end", "at most " + readableBytes({kMaxHeaderBytes}), "more"};
}

/// Converts an error code of libcurl from before the first byte of the body to a failure of the request. If a header
/// line is longer than 100 KiB, libcurl reports "out of memory", or "too large" (100) since version 8.6.
RangeFailure failureOf(CURLcode code, const char* reason) {
    constexpr int kTooLarge = 100;
    if (code == CURLE_OUT_OF_MEMORY || code == kTooLarge) return endlessHeader();
    return {isLasting(code) ? Refusal::Lasting : Refusal::Passing, *reason != 0 ? reason : curl_easy_strerror(code)};
}

/// Returns the failure of the request for an HTTP status other than 206 (partial content).
RangeFailure failureOf(long status, const Identity* known) {
    const std::string found = std::to_string(status);
    if (status == 200)
        return {
            known == nullptr ? Refusal::Lasting : Refusal::Changed,
            known == nullptr ? "the server gives no byte ranges, by which a model is read"
                             : "changed on the server, or the server gives no byte ranges any more",
            "HTTP status 206",
            found};
    if (status == 404 || status == 410)
        return {Refusal::Vanished, "the server has no such file", "HTTP status 206", found};
    if (status == 401 || status == 403)
        return {Refusal::Lasting, "the server does not let it be read", "HTTP status 206", found};
    if (status == 416)
        return {
            known == nullptr ? Refusal::Lasting : Refusal::Changed,
            known == nullptr ? "empty on the server" : "changed on the server: it ends earlier",
            "HTTP status 206",
            found};
    const bool mayPass = status >= 500 || status == 408 || status == 425 || status == 429;
    return {mayPass ? Refusal::Passing : Refusal::Lasting, "the server refuses", "HTTP status 206", found};
}

} // namespace

void PartHeader::take(std::string_view line) {
    if (lowered(line.substr(0, 5)) == "http/") {
        *this = {};
        return;
    }
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return;
    const std::string name = lowered(trimmed(line.substr(0, colon)));
    const std::string value(trimmed(line.substr(colon + 1)));
    if (name == "content-range") range = value;
    if (name == "content-encoding") encoding = value;
    if (name == "etag") identity.tag = value;
    if (name == "last-modified") identity.modified = value;
}

std::optional<PartPlace> partPlace(const std::string& range) {
    PartPlace place;
    std::string_view text = range;
    const bool isWhole = lowered(text.substr(0, 5)) == "bytes" && (text.remove_prefix(5), true) &&
                         takeText(text, " ") && takeNumber(text, place.first) && takeText(text, "-") &&
                         takeNumber(text, place.last) && takeText(text, "/") && takeNumber(text, place.of) &&
                         text.empty();
    if (!isWhole || place.first > place.last || place.last >= place.of) return std::nullopt;
    return place;
}

/// Suppresses the signal SIGPIPE while the object exists. The signal would end the process if a server closes the
/// connection.
class NoBrokenPipe {
public:
    NoBrokenPipe() {
        ::sigemptyset(&pipe_);
        ::sigaddset(&pipe_, SIGPIPE);
        ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }

    ~NoBrokenPipe() {
        const timespec now{};
        while (::sigtimedwait(&pipe_, nullptr, &now) == SIGPIPE) {
        }
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }

    NoBrokenPipe(const NoBrokenPipe&) = delete;
    NoBrokenPipe& operator=(const NoBrokenPipe&) = delete;
    NoBrokenPipe(NoBrokenPipe&&) = delete;
    NoBrokenPipe& operator=(NoBrokenPipe&&) = delete;

private:
    sigset_t pipe_{};
    sigset_t before_{};
};

/// The state of a running request for a byte range.
struct Connections::Request {
    CURL* handle = nullptr;
    std::uint64_t offset = 0;
    std::span<std::byte> out;
    const Identity* known = nullptr;
    const std::atomic<bool>* isStopped = nullptr;
    PartHeader header{};
    std::size_t headerBytes = 0;
    std::size_t wanted = 0; // size of the body; set after the check of the header
    RangeAnswer answer{};

    /// Records the first failure of the request. Returns false, so that the callback of libcurl ends the transfer.
    bool refuse(RangeFailure failure) {
        if (!answer.failure) answer.failure = std::move(failure);
        return false;
    }

    long status() const {
        long status = 0;
        curl_easy_getinfo(handle, CURLINFO_RESPONSE_CODE, &status);
        return status;
    }

    /// Returns true if the header of the server's answer is valid. It is checked before the first byte of the body is
    /// stored.
    bool isPart() {
        if (status() != 206) return refuse(failureOf(status(), known));
        const std::optional<PartPlace> place = partPlace(header.range);
        const std::uint64_t last = offset + out.size() - 1;
        const std::string asked = "bytes " + std::to_string(offset) + "-" + std::to_string(last) + "/";
        if (!header.encoding.empty() && lowered(header.encoding) != "identity")
            return refuse({Refusal::Lasting, "the server compresses its answer", "no encoding", header.encoding});
        if (!place || place->first != offset || place->last > last)
            return refuse({Refusal::Lasting, "the server sends another range", asked + "SIZE", header.range});
        header.identity.size = place->of;
        answer.identity = header.identity;
        if (known != nullptr && answer.identity != *known)
            return refuse(
                {Refusal::Changed,
                 "changed on the server since it was opened",
                 asked + std::to_string(known->size),
                 header.range});
        wanted = place->last - place->first + 1;
        return true;
    }

    static std::size_t onHeader(const char* data, std::size_t /*one*/, std::size_t size, void* request) {
        auto& self = *static_cast<Request*>(request);
        self.headerBytes += size;
        if (self.headerBytes > kMaxHeaderBytes) {
            self.refuse(endlessHeader());
            return 0;
        }
        self.header.take({data, size});
        return size;
    }

    static std::size_t onBody(const char* data, std::size_t /*one*/, std::size_t size, void* request) {
        auto& self = *static_cast<Request*>(request);
        if (size == 0) return 0;
        if (self.wanted == 0 && !self.isPart()) return 0;
        const std::size_t room = self.wanted - self.answer.received;
        std::memcpy(self.out.data() + self.answer.received, data, std::min(room, size));
        self.answer.received += std::min(room, size);
        if (size <= room) return size;
        self.refuse(
            {Refusal::Lasting,
             "the server sends more bytes than it announced",
             std::to_string(self.wanted) + " bytes",
             "more"});
        return 0;
    }

    static int onProgress(void* request, curl_off_t, curl_off_t, curl_off_t, curl_off_t) {
        return static_cast<const Request*>(request)->isStopped->load() ? 1 : 0;
    }
};

/// One connection of the pool to the server, idle or in use.
class Connections::Handle {
public:
    Handle(const std::string& address, const std::string& authorityFile) : curl_(curl_easy_init(), curl_easy_cleanup) {
        if (!curl_) throw std::bad_alloc();
        const bool isSecure = lowered(address.substr(0, 6)) == "https:";
        set(CURLOPT_URL, address.c_str());
        set(CURLOPT_PROTOCOLS_STR, "http,https");
        // A request that begins with https must not be redirected to plain http.
        set(CURLOPT_REDIR_PROTOCOLS_STR, isSecure ? "https" : "http,https");
        set(CURLOPT_FOLLOWLOCATION, 1L);
        set(CURLOPT_MAXREDIRS, kMaxRedirections);
        set(CURLOPT_HTTP_VERSION, long{CURL_HTTP_VERSION_2TLS});
        set(CURLOPT_NOSIGNAL, 1L);
        set(CURLOPT_CONNECTTIMEOUT, kConnectSeconds);
        set(CURLOPT_LOW_SPEED_LIMIT, kSlowRate);
        set(CURLOPT_LOW_SPEED_TIME, kSlowSeconds);
        set(CURLOPT_USERAGENT, "gnomon");
        set(CURLOPT_NOPROGRESS, 0L);
        set(CURLOPT_HEADERFUNCTION, &Request::onHeader);
        set(CURLOPT_WRITEFUNCTION, &Request::onBody);
        set(CURLOPT_XFERINFOFUNCTION, &Request::onProgress);
        set(CURLOPT_ERRORBUFFER, reason_.data());
        if (!authorityFile.empty()) {
            set(CURLOPT_CAINFO, authorityFile.c_str());
            set(CURLOPT_CAPATH, static_cast<const char*>(nullptr)); // only the given authorities are valid
        }
    }

    /// Executes `request` and stores its answer.
    void perform(Request& request) {
        const std::string range =
            std::to_string(request.offset) + "-" + std::to_string(request.offset + request.out.size() - 1);
        set(CURLOPT_RANGE, range.c_str());
        set(CURLOPT_HEADERDATA, &request);
        set(CURLOPT_WRITEDATA, &request);
        set(CURLOPT_XFERINFODATA, &request);
        request.handle = curl_.get();
        reason_.front() = 0;
        const NoBrokenPipe noSignal;
        const CURLcode code = curl_easy_perform(curl_.get());
        if (request.answer.failure) return;
        if (*request.isStopped) {
            request.refuse({Refusal::Lasting, "the request was cancelled"});
        } else if (code != CURLE_OK && code != CURLE_PARTIAL_FILE) {
            request.refuse(failureOf(code, reason_.data()));
        } else if (request.wanted == 0) { // without a body, the header was not checked yet
            const long status = request.status();
            if (status != 206)
                request.refuse(failureOf(status, request.known));
            else
                request.refuse({Refusal::Passing, "the server's answer has no bytes"});
        } else if (request.answer.received < request.wanted) {
            request.refuse(
                {Refusal::Passing,
                 "the server's answer ends too early",
                 std::to_string(request.wanted) + " bytes",
                 std::to_string(request.answer.received)});
        }
    }

    /// If the last request was redirected, returns the protocol, host and port of the target. Otherwise returns an
    /// empty text.
    std::string redirectedTo() const {
        long count = 0;
        char* url = nullptr;
        curl_easy_getinfo(curl_.get(), CURLINFO_REDIRECT_COUNT, &count);
        if (count == 0 || curl_easy_getinfo(curl_.get(), CURLINFO_EFFECTIVE_URL, &url) != CURLE_OK || url == nullptr)
            return {};
        const std::string_view address(url);
        const std::size_t begin = std::min(address.find("//") + 2, address.size());
        const std::string_view host = address.substr(begin, address.find_first_of("/?#", begin) - begin);
        return std::string(address.substr(0, begin)).append(host.substr(host.rfind('@') + 1));
    }

private:
    template <class Value>
    void set(CURLoption option, Value value) {
        if (curl_easy_setopt(curl_.get(), option, value) != CURLE_OK)
            throw Error("libcurl lacks option " + std::to_string(option));
    }

    std::unique_ptr<CURL, void (*)(CURL*)> curl_;
    std::array<char, CURL_ERROR_SIZE> reason_{};
};

Connections::Connections(std::string address, const Access& access)
    : address_(std::move(address)), authorityFile_(access.authorityFile) {
    if (!isLibraryReady()) throw Error("libcurl does not start");
}

Connections::~Connections() = default;

std::unique_ptr<Connections::Handle> Connections::taken() const {
    {
        const std::lock_guard lock(mutex_);
        if (!idle_.empty()) {
            std::unique_ptr<Handle> last = std::move(idle_.back()); // the most recently used connection
            idle_.pop_back();
            return last;
        }
    }
    return std::make_unique<Handle>(address_, authorityFile_);
}

RangeAnswer Connections::get(std::uint64_t offset, std::span<std::byte> out, const Identity* known) const {
    Request request;
    request.offset = offset;
    request.out = out;
    request.known = known;
    request.isStopped = &isStopped_;
    std::unique_ptr<Handle> handle = taken();
    handle->perform(request);
    const std::string host = handle->redirectedTo();
    std::optional<RangeFailure>& failure = request.answer.failure;
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(handle));
    if (request.answer.received > 0) {
        redirectedTo_ = host;
    } else if (failure && failure->refusal == Refusal::Passing && host != redirectedTo_ && !host.empty()) {
        // Retries would not help, because the target of the redirect has never answered.
        failure->refusal = Refusal::Lasting;
        failure->what = "redirected to " + host + ": " + failure->what;
    }
    return std::move(request.answer);
}

} // namespace gnomon::hierarchy
